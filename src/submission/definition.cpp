#include "submission/definition.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace meshfolio::submission {

namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)); }

// ---- what the compiler would not read as code becomes blank --------------------------------------------------------------

/// Comments, literals and preprocessor lines as spaces; every newline stays where it was.
class Blanker {
public:
    explicit Blanker(std::string_view text) : text_(text) {}

    std::string result() && {
        bool line_begins = true;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (line_begins && c == '#') {
                blank_directive();
            } else if (starts("//")) {
                blank_to(text_.find('\n', at_));
            } else if (starts("/*")) {
                blank_past("*/");
            } else if (starts("R\"") && !follows_word()) {
                blank_past(")" + std::string(text_.substr(at_ + 2, text_.find('(', at_) - at_ - 2)) + "\"");
            } else if (c == '"' || (c == '\'' && !follows_word())) {   // behind a word it parts digits: 1'000
                blank_literal(c);
            } else {
                if (!is_space(c)) line_begins = false;
                if (c == '\n') line_begins = true;
                result_ += c;
                ++at_;
            }
        }
        return std::move(result_);
    }

private:
    std::string_view text_;
    std::string result_ = {};
    std::size_t at_ = 0;

    bool starts(std::string_view word) const { return text_.substr(at_).starts_with(word); }
    bool follows_word() const { return at_ > 0 && is_word(text_[at_ - 1]); }

    void blank_to(std::size_t end) {
        for (end = std::min(end, text_.size()); at_ < end; ++at_) result_ += text_[at_] == '\n' ? '\n' : ' ';
    }
    void blank_past(const std::string& closing) {
        const std::size_t end = text_.find(closing, at_ + 2);
        blank_to(end == std::string_view::npos ? end : end + closing.size());
    }
    void blank_literal(char quote) {
        std::size_t end = at_ + 1;
        while (end < text_.size() && text_[end] != quote && text_[end] != '\n') end += text_[end] == '\\' ? 2 : 1;
        blank_to(end + 1);
    }
    void blank_directive() {
        std::size_t end = at_;
        do {
            end = text_.find('\n', end + 1);
        } while (end < text_.size() && text_[end - 1] == '\\');
        blank_to(end);
    }
};

// ---- what stands before a brace ------------------------------------------------------------------------------------------

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

/// The word the text begins with, taken off it.
std::string_view take_word(std::string_view& text) {
    text = trimmed(text);
    const auto end = std::find_if_not(text.begin(), text.end(), is_word);
    const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    text.remove_prefix(word.size());
    return word;
}

/// Of the first `wanted` outside angle brackets.
std::size_t find_outside_templates(std::string_view text, char wanted) {
    int angles = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == wanted && angles == 0) return i;
        if (text[i] == '<') ++angles;
        if (text[i] == '>' && angles > 0) --angles;
    }
    return std::string_view::npos;
}

/// Without "template <…>" in front.
std::string_view without_template(std::string_view head) {
    for (std::string_view rest = head; take_word(rest) == "template"; head = rest) {
        int angles = 0, parentheses = 0;
        std::size_t end = 0;
        for (bool closed = false; end < rest.size() && !closed; ++end) {
            const char c = rest[end];
            parentheses += c == '(' ? 1 : c == ')' ? -1 : 0;
            if (parentheses > 0) continue;   // there > compares
            angles += c == '<' ? 1 : c == '>' ? -1 : 0;
            closed = c == '>' && angles == 0;
        }
        rest.remove_prefix(end);
    }
    return trimmed(head);
}

bool opens_namespace(std::string_view head) {
    std::string_view rest = head;
    std::string_view word = take_word(rest);
    if (word == "inline") word = take_word(rest);
    return word == "namespace" || (word == "extern" && trimmed(rest).empty());   // extern "C", its literal blank
}

/// The last path of names, "A::b", at the end of the text.
std::string_view name_at_end(std::string_view text) {
    text = trimmed(text);
    std::size_t begin = text.size();
    while (begin > 0 && (is_word(text[begin - 1]) || text[begin - 1] == ':' || text[begin - 1] == '~')) --begin;
    return text.substr(begin);
}

/// What a definition with this head defines; empty: nothing that has a name.
std::string_view defined_name(std::string_view head) {
    head = without_template(trimmed(head));
    if (head.empty() || head.front() == ',') return {};   // the rest of a list of initialisers
    const std::size_t parenthesis = find_outside_templates(head, '(');
    std::string_view rest = head;
    std::string_view word = take_word(rest);
    if (parenthesis == std::string_view::npos) {
        if (word != "class" && word != "struct" && word != "union" && word != "enum") return {};
        const std::size_t bases = rest.find(" : ");
        rest = trimmed(rest.substr(0, bases));
        if (rest.ends_with(" final")) rest.remove_suffix(6);
        return name_at_end(rest);
    }
    const std::string_view before = head.substr(0, parenthesis);
    if (before.find('=') != std::string_view::npos) return {};   // a variable, initialised by a call; operators have no names here
    return name_at_end(before);
}

// ---- all of a file -------------------------------------------------------------------------------------------------------

/// The brace that closes the one at `open`, or the end.
std::size_t closing_brace(std::string_view code, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < code.size(); ++i) {
        if (code[i] == '{') ++depth;
        if (code[i] == '}' && --depth == 0) return i;
    }
    return code.size();
}

/// Names defined at namespace scope, as views into `code`.
std::vector<std::string_view> definitions(std::string_view code) {
    std::vector<std::string_view> names;
    int parentheses = 0;
    std::size_t head = 0;
    for (std::size_t i = 0; i < code.size(); ++i) {
        const char c = code[i];
        if (c == '(') ++parentheses;
        if (c == ')') --parentheses;
        if (parentheses > 0) continue;
        if (c == '{') {
            const std::string_view before = code.substr(head, i - head);
            if (!opens_namespace(before)) {
                const std::string_view name = defined_name(before);
                if (!name.empty()) names.push_back(name);
                i = closing_brace(code, i);
            }
        }
        if (c == ';' || c == '{' || c == '}') head = i + 1;
    }
    return names;
}

}   // namespace

long definition_line(std::string_view cpp, std::string_view name) {
    const std::string code = Blanker(cpp).result();
    const std::vector<std::string_view> names = definitions(code);
    auto found = std::find(names.begin(), names.end(), name);
    const std::string as_member = "::" + std::string(name);
    if (found == names.end()) {
        found = std::find_if(names.begin(), names.end(), [&](std::string_view n) { return n.ends_with(as_member); });
    }
    if (name.empty() || found == names.end()) return 0;
    const auto position = found->data() - code.data();
    return 1 + std::count(code.begin(), code.begin() + position, '\n');
}

}   // namespace meshfolio::submission
