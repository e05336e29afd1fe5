#include "run/cache_folder.h"

#include "base/errors.h"
#include "run/arguments.h"
#include "run/console.h"

namespace meshfolio::run {

namespace {

constexpr std::uintmax_t megabyte = 1'000'000;              // as `doctor` and `cache` tell sizes
constexpr std::uintmax_t default_limit = 2048 * megabyte;   // some ten full reports

}   // namespace

std::uintmax_t cache_limit() {
    const std::string given = environment("MESHFOLIO_CACHE_LIMIT");
    if (given.empty()) return default_limit;
    return static_cast<std::uintmax_t>(integer_between("MESHFOLIO_CACHE_LIMIT", given, 1, 1000000)) * megabyte;
}

std::unique_ptr<output::ResultCache> usable_cache() {
    const std::uintmax_t limit = cache_limit();
    const auto folder = output::default_cache_folder();
    if (!folder) {
        warn("no cache is used: neither XDG_CACHE_HOME nor HOME names a folder");
        return nullptr;
    }
    try {
        return std::make_unique<output::ResultCache>(*folder, limit);
    } catch (const OutputError& error) {
        warn("no cache is used: " + std::string(error.what()));
        return nullptr;
    }
}

}   // namespace meshfolio::run
