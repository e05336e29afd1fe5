#include "geometry/linear/blas_turn.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

namespace meshfolio {

namespace {

/// All that CHOLMOD calls for real matrices.
constexpr std::array routines{"dgemm_", "dgemv_", "dpotrf_", "dsyrk_", "dtrsm_", "dtrsv_"};

struct Closer {
    void operator()(void* library) const { ::dlclose(library); }
};

/// A function of that library, or of one that it needs; null where there is none of that name.
template <class Function>
Function* function_of(void* library, const char* name) {
    return reinterpret_cast<Function*>(::dlsym(library, name));
}

void hold_to_one_thread() {
    if (auto* const set_threads = function_of<void(int)>(RTLD_DEFAULT, "openblas_set_num_threads")) set_threads(1);
}

/// BLAS and LAPACK are chosen separately: each routine's own library is asked.
class Inquiry {
public:
    BlasLibrary run() {
        for (const char* routine : routines) ask(routine);
        found_.is_safe = all_safe_ && !found_.files.empty();
        if (found_.is_safe) hold_to_one_thread();
        return std::move(found_);
    }

private:
    void ask(const char* routine) {
        Dl_info place{};
        void* const address = ::dlsym(RTLD_DEFAULT, routine);
        if (address == nullptr || ::dladdr(address, &place) == 0 || place.dli_fname == nullptr) {
            all_safe_ = false;
            return;
        }
        std::error_code error;
        const auto file = std::filesystem::canonical(place.dli_fname, error);
        add_once(error ? std::string(place.dli_fname) : file.string());
        const std::unique_ptr<void, Closer> library(::dlopen(place.dli_fname, RTLD_LAZY | RTLD_NOLOAD));
        auto* const configuration = library ? function_of<char*()>(library.get(), "openblas_get_config") : nullptr;
        auto* const parallel = library ? function_of<int()>(library.get(), "openblas_get_parallel") : nullptr;
        if (configuration == nullptr || parallel == nullptr) {
            all_safe_ = false;
            return;
        }
        found_.configuration = configuration();
        all_safe_ = all_safe_ && guards_its_buffers(static_cast<BlasThreads>(parallel()), found_.configuration);
    }

    void add_once(const std::string& file) {
        if (std::find(found_.files.begin(), found_.files.end(), file) == found_.files.end()) found_.files.push_back(file);
    }

    BlasLibrary found_;
    bool all_safe_ = true;
};

}   // namespace

bool guards_its_buffers(BlasThreads threads, std::string_view configuration) {
    if (threads == BlasThreads::posix) return true;
    return threads == BlasThreads::none && configuration.find("USE_LOCKING") != std::string_view::npos;
}

const BlasLibrary& blas_library() {
    static const BlasLibrary library = Inquiry().run();
    return library;
}

std::unique_lock<std::mutex> blas_turn() {
    static std::mutex mutex;
    if (blas_library().is_safe) return {};
    std::unique_lock turn(mutex);
    hold_to_one_thread();   // with OpenMP a number of the thread that calls
    return turn;
}

}   // namespace meshfolio
