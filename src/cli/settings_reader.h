/// @file
/// Values out of TOML tables, each checked; what is wrong is collected with its line and reading goes on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Before the library: deeper nesting is refused by its parser, which recurses.
#define TOML_MAX_NESTED_VALUES 64
#include <toml++/toml.h>

#include "errors.h"

namespace meshfolio::cli {

class Problems {
public:
    explicit Problems(std::string file) : file_(std::move(file)) {}
    void add(const toml::node& where, const std::string& problem, const std::string& remedy = "");
    void add(long line, const std::string& problem, const std::string& remedy = "");
    /// @throws SettingsErrors, in order of their lines, if there is any
    void raise() const;

private:
    struct Problem {
        long line;
        UsageError error;
    };
    std::string file_;
    std::vector<Problem> problems_;
};

/// Reads the keys of one table. A value that is missing or wrong is nothing; wrong ones are reported.
class TableReader {
public:
    /// @param name   of the table in messages: "[report]"
    /// @param known  every key it may have; others are reported, with the nearest known one
    TableReader(const toml::table& table, std::string name, const std::vector<std::string>& known, Problems& problems);

    std::optional<std::string> text(std::string_view key) const;
    std::optional<bool> truth(std::string_view key) const;
    std::optional<long long> integer(std::string_view key, long long low, long long high) const;
    /// One value or a list of 1 to limits::largest_list of them; empty when the key is missing or a value is wrong.
    std::vector<std::string> texts(std::string_view key) const;
    std::vector<int> integers(std::string_view key, long long low, long long high) const;
    /// `above`: the smallest value itself is refused.
    std::vector<double> numbers(std::string_view key, double low, double high, bool above) const;

    const toml::node* node(std::string_view key) const { return table_.get(key); }
    std::string called(std::string_view key) const { return name_ + (name_.empty() ? "" : " ") + std::string(key); }

private:
    const toml::table& table_;
    std::string name_;
    Problems& problems_;

    template <class Value, class ReadOne>
    std::vector<Value> one_or_several(std::string_view key, ReadOne read_one) const;
    std::optional<std::string> text_of(const toml::node& node, const std::string& name) const;
    std::optional<long long> integer_of(const toml::node& node, const std::string& name, long long low, long long high) const;
    std::optional<double> number_of(const toml::node& node, const std::string& name, double low, double high, bool above) const;
};

}   // namespace meshfolio::cli
