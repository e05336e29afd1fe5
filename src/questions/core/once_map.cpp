#include "questions/core/once_map.h"

#include <tbb/task_arena.h>

namespace meshfolio {

OnceMap::Pointer OnceMap::pointer(const std::string& key, const std::function<Pointer()>& make) {
    std::promise<Pointer> promise;
    std::unique_lock lock(mutex_);
    const auto [entry, is_first] = values_.try_emplace(key);
    if (is_first) entry->second = promise.get_future().share();
    const std::shared_future<Pointer> value = entry->second;
    lock.unlock();
    if (!is_first) return value.get();
    try {
        // Isolated: a loop inside must not take a task that waits for the same key.
        promise.set_value(tbb::this_task_arena::isolate(make));
    } catch (...) {
        lock.lock();
        values_.erase(key);
        lock.unlock();
        promise.set_exception(std::current_exception());
    }
    return value.get();
}

}   // namespace meshfolio
