/// @file
/// Values that several chapters need, each made once.
#pragma once

#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>

namespace meshfolio {

/// Values of any type by key. Thread-safe.
class OnceMap {
public:
    /// Returns the value of `key`, which lives as long as the map. The first caller makes it; others wait for this key alone.
    /// @throws what `make` throws, in all callers that waited for it; the next caller makes the value again
    const auto& value(const std::string& key, const auto& make) {
        using Value = const std::remove_cvref_t<decltype(make())>;
        return *static_cast<Value*>(pointer(key, [&] { return std::make_shared<Value>(make()); }).get());
    }

private:
    using Pointer = std::shared_ptr<const void>;
    std::mutex mutex_;
    std::map<std::string, std::shared_future<Pointer>> values_;

    Pointer pointer(const std::string& key, const std::function<Pointer()>& make);
};

}   // namespace meshfolio
