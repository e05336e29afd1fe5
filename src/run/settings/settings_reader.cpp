#include "run/settings/settings_reader.h"

#include <algorithm>
#include <cmath>

#include "base/in_quotes.h"
#include "base/nearest_word.h"
#include "base/number_text.h"

namespace meshfolio::run {

namespace {

std::string type_name(const toml::node& node) {
    if (node.is_table()) return "a table";
    if (node.is_array()) return node.is_array_of_tables() ? "a list of tables" : "a list";
    if (node.is_string()) return "a text";
    if (node.is_integer()) return "an integer";
    if (node.is_floating_point()) return "a number with a fraction";
    return node.is_boolean() ? "a truth value" : "a date or time";
}

std::string between(const std::string& low, const std::string& high) { return "from " + low + " to " + high; }

std::string nearest_of(const std::string& word, const std::vector<std::string>& known) {
    return known.empty() ? "leave it out: nothing is known here" : "did you mean '" + nearest_word(word, known) + "'?";
}

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

namespace {

/// Skips comments and strings of TOML. After a syntax error the result does not matter, as the parser stops there.
class TomlSkipper {
public:
    explicit TomlSkipper(std::string_view text) : text_(text) {}

    bool ended() const { return at_ >= text_.size(); }
    char next() { return text_[at_++]; }
    /// Skips a comment, after its '#'.
    void comment() { at_ = std::min(text_.find('\n', at_), text_.size()); }
    /// Skips a text, after its first quote.
    void quoted(char quote) {
        const std::string three(3, quote);
        if (text_.substr(at_ - 1).starts_with(three)) return to_end_of_lines(three);
        for (; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
            if (text_[at_] == quote) {
                ++at_;
                return;
            }
            if (text_[at_] == '\\' && quote == '"') ++at_;
        }
    }
    std::size_t at() const { return std::min(at_, text_.size()); }

private:
    /// Skips the rest of a text in triple quotes, which may end with up to two quotes more.
    void to_end_of_lines(const std::string& three) {
        at_ += 2;
        while (at_ < text_.size() && !text_.substr(at_).starts_with(three)) at_ += text_[at_] == '\\' && three[0] == '"' ? 2 : 1;
        at_ += 3;
        for (int more = 0; more < 2 && at_ < text_.size() && text_[at_] == three[0]; ++more) ++at_;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}   // namespace

long line_of_long_key(std::string_view text) {
    TomlSkipper skipper(text);
    long long dots = 0;
    while (!skipper.ended()) {
        const char c = skipper.next();
        const bool of_key = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
        if (c == '#') {
            skipper.comment();
        } else if (c == '"' || c == '\'') {
            skipper.quoted(c);
        } else if (c == '.') {
            if (++dots >= limits::longest_key) return 1 + std::count(text.begin(), text.begin() + static_cast<long>(skipper.at()), '\n');
        } else if (!of_key && c != ' ' && c != '\t') {
            dots = 0;
        }
    }
    return 0;
}

std::optional<toml::table> parsed_toml(std::string_view text, const std::string& file, Problems& problems) {
    if (const long line = line_of_long_key(text); line > 0) {
        problems.add(line, "a key has more than " + std::to_string(limits::longest_key) + " parts between dots",
                     "shorten it: known keys have at most two");
        return {};
    }
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        problems.add(static_cast<long>(error.source().begin.line), std::string(error.description()), "correct the TOML");
        return {};
    }
}

void for_each_table(const toml::node& node, const std::string& name, Problems& problems,
                    const std::function<void(const toml::table&)>& read) {
    const std::string remedy = "write [[" + name + "]] above each";
    const toml::array* list = node.as_array();
    if (list == nullptr || list->empty()) problems.add(node, name + " is not a list of tables", remedy);
    if (const toml::table* table = node.as_table()) read(*table);
    if (list == nullptr) return;
    for (std::size_t i = 0; i < list->size(); ++i) {
        if (const toml::table* table = (*list)[i].as_table()) {
            read(*table);
        } else {
            problems.add((*list)[i], name + "[" + std::to_string(i) + "] is " + type_name((*list)[i]) + ", not a table", remedy);
        }
    }
}

TableReader::TableReader(const toml::table& table, std::string name, const std::vector<std::string>& known, Problems& problems,
                         const std::vector<std::string>& tables)
    : table_(table), name_(std::move(name)), problems_(problems) {
    for (const auto& [key, value] : table) {
        const std::string word(key.str());
        if (contains(known, word) || contains(tables, word)) continue;
        const bool is_table = value.is_table() || value.is_array_of_tables();
        const std::string place = name_.empty() ? "" : " in " + name_;
        const std::vector<std::string>& like = is_table && !tables.empty() ? tables : known;
        problems.add(static_cast<long>(key.source().begin.line), (is_table ? "unknown table " : "unknown key ") + in_quotes(word) + place,
                     is_table && tables.empty() ? name_ + " has no tables within it" : nearest_of(word, like));
    }
}

std::size_t TableReader::size(std::string_view key) const {
    const toml::node* found = node(key);
    if (found == nullptr) return 0;
    return found->is_array() ? found->as_array()->size() : 1;
}

std::optional<std::string> TableReader::text_of(const toml::node& node, const std::string& name) const {
    if (const auto* value = node.as_string()) return value->get();
    problems_.add(node, name + " is " + type_name(node) + ", not a text", "write it in quotes");
    return {};
}

std::optional<long long> TableReader::integer_of(const toml::node& node, const std::string& name, long long low, long long high) const {
    const auto* value = node.as_integer();
    if (value == nullptr) {
        problems_.add(node, name + " is " + type_name(node) + ", not an integer", "write a whole number");
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
        problems_.add(node, name + " is " + type_name(node) + ", not a number", "write a decimal number");
    } else if (!std::isfinite(*value)) {
        problems_.add(node, name + " is not finite", "write a decimal number");
    } else if (*value < low || *value > high || (above && *value == low)) {
        problems_.add(node, name + " = " + plain_text(*value) + " is out of range",
                      "it may be " + (above ? "above " + plain_text(low) + " and at most " + plain_text(high)
                                            : between(plain_text(low), plain_text(high))));
    } else {
        return value;
    }
    return {};
}

std::optional<std::string> TableReader::text(std::string_view key, std::size_t longest) const {
    const toml::node* found = node(key);
    auto text = found != nullptr ? text_of(*found, called(key)) : std::nullopt;
    if (text && text->size() > longest)
        problems_.add(*found, called(key) + " has " + std::to_string(text->size()) + " bytes",
                      "at most " + std::to_string(longest) + " are allowed");
    return text;
}

std::optional<std::string> TableReader::word(std::string_view key, const std::vector<std::string>& known) const {
    auto word = text(key);
    if (!word || contains(known, *word)) return word;
    problems_.add(*node(key), called(key) + ": " + in_quotes(*word) + " is unknown", nearest_of(*word, known));
    return {};
}

std::optional<bool> TableReader::truth(std::string_view key) const {
    const toml::node* found = node(key);
    if (found == nullptr) return {};
    if (const auto* value = found->as_boolean()) return value->get();
    problems_.add(*found, called(key) + " is " + type_name(*found) + ", not true or false", "write one of them, without quotes");
    return {};
}

std::optional<long long> TableReader::integer(std::string_view key, long long low, long long high) const {
    const toml::node* found = node(key);
    return found != nullptr ? integer_of(*found, called(key), low, high) : std::nullopt;
}

template <class Value, class ReadOne> std::vector<Value> TableReader::one_or_several(std::string_view key, ReadOne read_one) const {
    std::vector<Value> values;
    const toml::node* found = node(key);
    if (found == nullptr) return values;
    const auto take = [&](const toml::node& element, const std::string& name) {
        const auto value = read_one(element, name);
        if (value) values.push_back(static_cast<Value>(*value));
    };
    if (const toml::array* list = found->as_array()) {
        if (list->empty()) problems_.add(*found, called(key) + " is an empty list", "fill it, or leave the key out");
        if (list->size() > static_cast<std::size_t>(limits::largest_list)) {
            problems_.add(*found, called(key) + " has " + std::to_string(list->size()) + " values",
                          "at most " + std::to_string(limits::largest_list) + " are allowed");
            return {};
        }
        for (std::size_t i = 0; i < list->size(); ++i) take((*list)[i], called(key) + "[" + std::to_string(i) + "]");
    } else {
        take(*found, called(key));
    }
    return values;
}

std::vector<std::string> TableReader::texts(std::string_view key, const Check& check) const {
    return one_or_several<std::string>(key, [&](const toml::node& node, const std::string& name) {
        auto text = text_of(node, name);
        if (text && check) check(*text, node);
        return text;
    });
}

std::vector<std::string> TableReader::words(std::string_view key, const std::vector<std::string>& known) const {
    std::vector<std::string> good;
    texts(key, [&](const std::string& word, const toml::node& where) {
        if (!contains(known, word)) {
            problems_.add(where, called(key) + ": " + in_quotes(word) + " is unknown", nearest_of(word, known));
        } else if (contains(good, word)) {
            problems_.add(where, called(key) + ": '" + word + "' is given twice", "name it once");
        } else {
            good.push_back(word);
        }
    });
    return good;
}

std::vector<int> TableReader::integers(std::string_view key, long long low, long long high) const {
    return one_or_several<int>(key, [&](const toml::node& node, const std::string& name) { return integer_of(node, name, low, high); });
}

std::vector<double> TableReader::numbers(std::string_view key, double low, double high, bool above) const {
    return one_or_several<double>(key,
                                  [&](const toml::node& node, const std::string& name) { return number_of(node, name, low, high, above); });
}

double TableReader::number(std::string_view key, double low, double high, bool above, double fallback) const {
    const std::vector<double> values = numbers(key, low, high, above);
    if (size(key) > 1) problems_.add(*node(key), called(key) + " is a list", "give one number");
    return values.empty() ? fallback : values.front();
}

}   // namespace meshfolio::run
