/// @file
/// Values out of TOML tables, each checked; what is wrong is collected with its line and reading goes on.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Before the library: deeper nesting is refused by its parser, which recurses.
#define TOML_MAX_NESTED_VALUES 64
// toml++ 3.3 asserts, and with NDEBUG lets Clang assume, what damaged files break, such as a key that begins with a dot; right behind it
// finds the mistake out and says so. So neither.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include "cli/settings_errors.h"
#include "questions/settings.h"

namespace meshfolio::cli {

class Problems {
public:
    explicit Problems(std::string file) : file_(std::move(file)) {}
    void add(const toml::node& where, const std::string& problem, const std::string& remedy = "");
    void add(long line, const std::string& problem, const std::string& remedy = "");
    /// @throws SettingsErrors, in order of their lines, if there is any
    void raise() const;

    /// Runs a part of the reading; what it complains of becomes one of the problems.
    template <class Part>
    void collect(Part part) {
        try {
            part();
        } catch (const SettingsErrors& errors) {
            for (const UsageError& error : errors.problems()) problems_.push_back({0, error});
        } catch (const UsageError& error) {
            problems_.push_back({0, error});
        }
    }

private:
    struct Problem {
        long line;
        UsageError error;
    };
    std::string file_;
    std::vector<Problem> problems_;
};

namespace limits {
using namespace meshfolio::limits;
inline constexpr long long longest_key = 16;                  // parts of a key: a.b.c has three
inline constexpr std::uintmax_t largest_settings = 1 << 20;   // bytes of a file
}   // namespace limits

/// The line of the first key of more parts than limits::longest_key, or 0. The parser makes a table of each part, and they are taken apart
/// by recursion, as deep as the key is long.
long line_of_long_key(std::string_view text);

/// Calls `read` with each table of a list of tables; what is something else is reported.
void for_each_table(const toml::node& node, const std::string& name, Problems& problems,
                    const std::function<void(const toml::table&)>& read);

/// Reads the keys of one table. A value that is missing or wrong is nothing; wrong ones are reported.
class TableReader {
public:
    /// @param name   of the table in messages: "[report]"
    /// @param known   every key it may have; others are reported, with the nearest known one
    /// @param tables  every table it may have within; the same holds for others
    TableReader(const toml::table& table, std::string name, const std::vector<std::string>& known, Problems& problems,
                const std::vector<std::string>& tables = {});

    std::optional<std::string> text(std::string_view key) const;
    std::optional<bool> truth(std::string_view key) const;
    std::optional<long long> integer(std::string_view key, long long low, long long high) const;
    /// One value or a list of 1 to limits::largest_list of them, without those that are wrong; empty when the key is missing.
    /// `check` looks at each text where it stands.
    using Check = std::function<void(const std::string& text, const toml::node& where)>;
    std::vector<std::string> texts(std::string_view key, const Check& check = {}) const;
    std::vector<int> integers(std::string_view key, long long low, long long high) const;
    /// `above`: the smallest value itself is refused.
    std::vector<double> numbers(std::string_view key, double low, double high, bool above) const;

    const toml::node* node(std::string_view key) const { return table_.get(key); }
    /// How many values are given, good or not; 0 when the key is missing.
    std::size_t size(std::string_view key) const;
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
