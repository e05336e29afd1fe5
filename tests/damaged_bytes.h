/// @file
/// A good file damaged in every way that touches one place, for readers that must survive all of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace meshfolio::testing_tools {

/// Calls `read` with the bytes cut off at each `step`-th position, and with each `step`-th byte changed in several ways, left out, or there
/// twice.
template <class Read> void for_each_damage(const std::string& bytes, Read read, std::size_t step = 1) {
    for (std::size_t at = 0; at <= bytes.size(); at += step) {
        SCOPED_TRACE("cut off at byte " + std::to_string(at));
        read(bytes.substr(0, at));
    }
    std::string damaged = bytes;
    for (std::size_t at = 0; at < bytes.size(); at += step) {
        SCOPED_TRACE("changed at byte " + std::to_string(at));
        const char good = bytes[at];
        const auto flipped = [&](int mask) { return static_cast<char>(good ^ mask); };
        for (const char bad : {flipped(1), flipped(0x10), flipped(0x80), flipped(0xff), '\0', '\n', ' ', '9', '-', '"'}) {
            damaged[at] = bad;
            read(damaged);
        }
        damaged[at] = good;
        read(bytes.substr(0, at) + bytes.substr(at + 1));
        read(bytes.substr(0, at) + good + bytes.substr(at));
    }
}

/// Passes when a message is one line about the file, without anything that could steer a terminal.
inline ::testing::AssertionResult is_one_line_about(std::string_view file, std::string_view message) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    for (const char c : message) {
        if (is_control(c)) return ::testing::AssertionFailure() << "control character " << int(c) << " in: " << message;
    }
    if (!message.starts_with(file)) return ::testing::AssertionFailure() << "does not begin with " << file << ": " << message;
    if (message.size() > 500) return ::testing::AssertionFailure() << message.size() << " bytes: " << message;
    return ::testing::AssertionSuccess();
}

}   // namespace meshfolio::testing_tools
