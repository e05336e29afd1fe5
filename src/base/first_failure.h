/// @file
/// Pieces of work side by side, of which the first that fails stops the others.
#pragma once

#include <atomic>
#include <exception>

namespace meshfolio {

/// Keeps the exception thrown first; what the others throw because of it never takes its place.
class FirstFailure {
public:
    struct OtherFailed {};   // thrown by check

    /// To be called by work in progress. @throws OtherFailed if other work has failed
    void check() const {
        if (happened_) throw OtherFailed();
    }
    /// Calls work(), unless other work has failed already; from several threads at once.
    template <class Work>
    void guard(const Work& work) {
        if (happened_) return;
        try {
            work();
        } catch (const OtherFailed&) {   // the first is known
        } catch (...) {
            if (!happened_.exchange(true)) exception_ = std::current_exception();
        }
    }
    /// When all work has ended.
    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

private:
    std::atomic<bool> happened_ = false;
    std::exception_ptr exception_;
};

}   // namespace meshfolio
