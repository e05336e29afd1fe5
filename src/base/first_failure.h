/// @file
/// Parallel work that stops at the first failure.
#pragma once

#include <atomic>
#include <exception>

namespace meshfolio {

/// Keeps the first exception of parallel pieces of work and skips the pieces not yet begun.
class FirstFailure {
public:
    struct OtherFailed {};

    /// Lets work in progress end early. @throws OtherFailed if other work has failed
    void check() const {
        if (happened_) throw OtherFailed();
    }
    /// Calls work() and keeps what it throws, unless other work has failed before. May be called from several threads at once.
    template <class Work>
    void guard(const Work& work) {
        if (happened_) return;
        try {
            work();
        } catch (const OtherFailed&) {   // the first failure is kept already
        } catch (...) {
            if (!happened_.exchange(true)) exception_ = std::current_exception();
        }
    }
    /// Throws the first exception again, if there is one; to be called when all work has ended.
    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

private:
    std::atomic<bool> happened_ = false;
    std::exception_ptr exception_;
};

}   // namespace meshfolio
