#include "cli/settings_reader.h"

#include <algorithm>
#include <cmath>

#include "cli/settings_file.h"
#include "nearest_word.h"
#include "number_text.h"
#include "questions/settings.h"

namespace meshfolio::cli {

namespace {

std::string type_name(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return node.is_array_of_tables() ? "a list of tables" : "a list";
        case toml::node_type::string:
            return "a text";
        case toml::node_type::integer:
            return "an integer";
        case toml::node_type::floating_point:
            return "a number with a fraction";
        case toml::node_type::boolean:
            return "a truth value";
        default:
            return "a date or time";
    }
}

std::string between(const std::string& low, const std::string& high) { return "from " + low + " to " + high; }

}   // namespace

void Problems::add(const toml::node& where, const std::string& problem, const std::string& remedy) {
    add(static_cast<long>(where.source().begin.line), problem, remedy);
}

void Problems::add(long line, const std::string& problem, const std::string& remedy) {
    problems_.push_back({line, UsageError(problem, remedy, {file_, line})});
}

void Problems::raise() const {
    if (problems_.empty()) return;
    std::vector<Problem> sorted = problems_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) { return a.line < b.line; });
    std::vector<UsageError> errors;
    for (const Problem& problem : sorted) errors.push_back(problem.error);
    throw SettingsErrors(std::move(errors));
}

TableReader::TableReader(const toml::table& table, std::string name, const std::vector<std::string>& known, Problems& problems)
    : table_(table), name_(std::move(name)), problems_(problems) {
    for (const auto& [key, value] : table) {
        const std::string word(key.str());
        if (std::find(known.begin(), known.end(), word) != known.end()) continue;
        const std::string kind = value.is_table() || value.is_array_of_tables() ? "table" : "key";
        const std::string place = name_.empty() ? "" : " in " + name_;
        problems.add(static_cast<long>(key.source().begin.line), "unknown " + kind + " '" + word + "'" + place,
                     "did you mean '" + nearest_word(word, known) + "'?");
    }
}

std::optional<std::string> TableReader::text_of(const toml::node& node, const std::string& name) const {
    if (const auto* value = node.as_string()) return value->get();
    problems_.add(node, name + " is " + type_name(node) + ", not a text");
    return {};
}

std::optional<long long> TableReader::integer_of(const toml::node& node, const std::string& name, long long low, long long high) const {
    const auto* value = node.as_integer();
    if (value == nullptr) {
        problems_.add(node, name + " is " + type_name(node) + ", not an integer");
    } else if (value->get() < low || value->get() > high) {
        problems_.add(node, name + " = " + std::to_string(value->get()) + " is out of range",
                      "it may be " + between(std::to_string(low), std::to_string(high)));
    } else {
        return value->get();
    }
    return {};
}

std::optional<double> TableReader::number_of(const toml::node& node, const std::string& name, double low, double high, bool above) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) {
        problems_.add(node, name + " is " + type_name(node) + ", not a number");
    } else if (!std::isfinite(*value)) {
        problems_.add(node, name + " is not finite");
    } else if (*value < low || *value > high || (above && *value == low)) {
        problems_.add(node, name + " = " + plain_text(*value) + " is out of range",
                      "it may be " + (above ? "above " + plain_text(low) + " and at most " + plain_text(high)
                                            : between(plain_text(low), plain_text(high))));
    } else {
        return value;
    }
    return {};
}

std::optional<std::string> TableReader::text(std::string_view key) const {
    const toml::node* found = node(key);
    return found != nullptr ? text_of(*found, called(key)) : std::nullopt;
}

std::optional<bool> TableReader::truth(std::string_view key) const {
    const toml::node* found = node(key);
    if (found == nullptr) return {};
    if (const auto* value = found->as_boolean()) return value->get();
    problems_.add(*found, called(key) + " is " + type_name(*found) + ", not true or false");
    return {};
}

std::optional<long long> TableReader::integer(std::string_view key, long long low, long long high) const {
    const toml::node* found = node(key);
    return found != nullptr ? integer_of(*found, called(key), low, high) : std::nullopt;
}

template <class Value, class ReadOne>
std::vector<Value> TableReader::one_or_several(std::string_view key, ReadOne read_one) const {
    std::vector<Value> values;
    const toml::node* found = node(key);
    if (found == nullptr) return values;
    bool all_good = true;
    const auto take = [&](const toml::node& element, const std::string& name) {
        const auto value = read_one(element, name);
        if (value) values.push_back(static_cast<Value>(*value));
        all_good &= value.has_value();
    };
    if (const toml::array* list = found->as_array()) {
        if (list->empty()) problems_.add(*found, called(key) + " is an empty list", "leave the key out for the question's own choice");
        if (list->size() > static_cast<std::size_t>(limits::largest_list)) {
            problems_.add(*found, called(key) + " has " + std::to_string(list->size()) + " values",
                          "at most " + std::to_string(limits::largest_list) + " are allowed");
            return {};
        }
        for (std::size_t i = 0; i < list->size(); ++i) take((*list)[i], called(key) + "[" + std::to_string(i) + "]");
    } else {
        take(*found, called(key));
    }
    return all_good ? values : std::vector<Value>{};
}

std::vector<std::string> TableReader::texts(std::string_view key) const {
    return one_or_several<std::string>(key, [&](const toml::node& node, const std::string& name) { return text_of(node, name); });
}

std::vector<int> TableReader::integers(std::string_view key, long long low, long long high) const {
    return one_or_several<int>(key, [&](const toml::node& node, const std::string& name) { return integer_of(node, name, low, high); });
}

std::vector<double> TableReader::numbers(std::string_view key, double low, double high, bool above) const {
    return one_or_several<double>(key,
                                  [&](const toml::node& node, const std::string& name) { return number_of(node, name, low, high, above); });
}

}   // namespace meshfolio::cli
