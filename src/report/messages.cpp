// Reads the messages of templates/words and formats them with facts.
#include <algorithm>
#include <set>
#include <stdexcept>

#include "base/errors.h"
#include "base/lower_case.h"
#include "base/number_text.h"
#include "report/numbering.h"
#include "report/words.h"

namespace meshfolio::report {

namespace {

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? "" : std::string(text.substr(first, last - first + 1));
}

const Fact& fact_named(std::string_view name, const Facts& facts, std::string_view message) {
    const auto fact = std::ranges::find(facts, name, &Fact::name);
    if (fact == facts.end()) throw std::logic_error("the message '" + std::string(message) + "' lacks the fact " + std::string(name));
    return *fact;
}

/// Returns the text for the placeholder "name" or "name|one|many".
Text filled(std::string_view placeholder, const Facts& facts, std::string_view message) {
    const std::size_t bar = placeholder.find('|');
    const Fact& fact = fact_named(placeholder.substr(0, bar), facts, message);
    const auto* count = std::get_if<long long>(&fact.value);
    if (bar != std::string_view::npos) {
        const std::size_t second = placeholder.find('|', bar + 1);
        if (count == nullptr || second == std::string_view::npos)
            throw std::logic_error("'" + std::string(placeholder) + "' needs a count, and words for one and for many");
        return text(std::string(*count == 1 ? placeholder.substr(bar + 1, second - bar - 1) : placeholder.substr(second + 1)));
    }
    if (count != nullptr) return text(readable_count(*count));
    if (const auto* words = std::get_if<std::string>(&fact.value)) return text(*words);
    if (const auto* running = std::get_if<Text>(&fact.value)) return *running;
    throw std::logic_error("'" + std::string(placeholder) + "' is a list: it needs a section");
}

/// Formats one paragraph as runs.
class Reader {
public:
    Reader(std::string_view paragraph, const Facts& facts, bool markup, bool whole = true)
        : all_(paragraph), left_(paragraph), facts_(facts), markup_(markup), whole_(whole) {}

    Text text() {
        while (!left_.empty()) {
            if (take("\\") && !left_.empty()) {
                add(left_.substr(0, 1));
                left_.remove_prefix(1);
            } else if (take("{{#")) {
                add_section(false);
            } else if (take("{{^")) {
                add_section(true);
            } else if (take("{{")) {
                for (Run& run : filled(until("}}"), facts_, all_)) add(std::move(run));
            } else if (left_.starts_with(" %") && is_digit(last_character())) {
                take(" %");
                add("\u202f%");   // no line break here, as in readable_percent
            } else if (!markup_ || !took_markup()) {
                add(left_.substr(0, 1));
                left_.remove_prefix(1);
            }
        }
        while (whole_ && last_character() == ' ') {
            text_.back().content.pop_back();
            if (text_.back().content.empty()) text_.pop_back();
        }
        return std::move(text_);
    }

private:
    std::string_view all_, left_;
    const Facts& facts_;
    bool markup_;
    bool whole_;   // a paragraph, whose blanks at the ends are removed; false: a section of one
    Text text_;

    /// Formats the section {{#name}}…{{/name}} that begins here if its fact holds, once for each entry of a list; an inverted one if the
    /// fact does not hold.
    void add_section(bool inverted) {
        const std::string_view name = until("}}"), inside = until("{{/" + std::string(name) + "}}");
        const auto& value = fact_named(name, facts_, all_).value;
        FactList repeats;
        if (const auto* list = std::get_if<FactList>(&value)) repeats = *list;
        const auto* count = std::get_if<long long>(&value);
        const auto* words = std::get_if<std::string>(&value);
        const auto* running = std::get_if<Text>(&value);
        if ((count && *count > 0) || (words && !words->empty()) || (running && !running->empty())) repeats.resize(1);
        if (inverted) repeats.resize(repeats.empty() ? 1 : 0);
        for (Facts& facts : repeats) {
            facts.insert(facts.end(), facts_.begin(), facts_.end());
            for (Run& run : Reader(inside, facts, markup_, false).text()) add(std::move(run));
        }
    }

    bool take(std::string_view mark) {
        if (!left_.starts_with(mark)) return false;
        left_.remove_prefix(mark.size());
        return true;
    }

    /// Returns the last character so far; zero if there is none.
    char last_character() const { return text_.empty() || text_.back().content.empty() ? '\0' : text_.back().content.back(); }

    std::string_view until(std::string_view mark) {
        const std::size_t end = left_.find(mark);
        if (end == std::string_view::npos) throw std::logic_error("'" + std::string(all_) + "' lacks " + std::string(mark));
        const std::string_view inside = left_.substr(0, end);
        left_.remove_prefix(end + mark.size());
        return inside;
    }

    bool took_markup() {
        static constexpr struct {
            std::string_view open, close;
            Run::Kind kind;
        } marks[] = {{"[[", "]]", Run::Kind::reference},
                     {"**", "**", Run::Kind::strong},
                     {"*", "*", Run::Kind::emphasis},
                     {"`", "`", Run::Kind::code},
                     {"$", "$", Run::Kind::math}};
        for (const auto& mark : marks) {
            if (!take(mark.open)) continue;
            text_.push_back({mark.kind, plain(Reader(until(mark.close), facts_, false).text())});
            return true;
        }
        return false;
    }

    void add(std::string_view words) { add(Run{Run::Kind::plain, std::string(words)}); }

    void add(Run run) {
        const bool after_blank = text_.empty() ? whole_ : last_character() == ' ';
        if (run.kind == Run::Kind::plain && run.content.starts_with(' ') && after_blank)
            run.content.erase(0, 1);   // a section was left out
        if (run.kind != Run::Kind::plain || !run.content.empty()) extend(text_, std::move(run));
    }
};

}   // namespace

std::vector<Message> messages_of(std::string_view text, const std::string& file) {
    std::vector<Message> messages;
    long line = 0;
    bool open = false;   // the paragraph goes on
    while (!text.empty()) {
        ++line;
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string words = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (words.starts_with("## ")) {
            messages.push_back({trimmed(std::string_view(words).substr(3)), {}, line});
            open = false;
        } else if (words.empty() || words.starts_with("# ")) {
            open = false;
        } else if (messages.empty()) {
            throw UsageError("a sentence before the first message", "begin a message with a line '## key'", {file, line});
        } else {
            std::vector<std::string>& paragraphs = messages.back().paragraphs;
            const bool alone = words.starts_with("### ") || words.starts_with("$$"), item = words.starts_with("- ");
            if (open && !alone && !item) paragraphs.back() += " " + words;
            else paragraphs.push_back(words);
            open = !alone;
        }
    }
    return messages;
}

Text running_text(std::string_view paragraph, const Facts& facts) { return Reader(paragraph, facts, true).text(); }

std::string running_line(std::string_view paragraph, const Facts& facts) { return plain(Reader(paragraph, facts, false).text()); }

std::vector<Block> own_blocks(std::string_view text) {
    std::string lines = "## own\n";   // the text in the format of the words
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t hashes = std::min(line.find_first_not_of('#'), line.size());
        const std::size_t digits = std::min(line.find_first_not_of("0123456789"), line.size());
        if (hashes > 0 && line.substr(hashes).starts_with(' ')) line = "\n**" + trimmed(std::string_view(line).substr(hashes)) + "**\n";
        if (digits > 0 && line.substr(digits).starts_with(". ")) line = "\n" + line;
        if (line.starts_with("* ")) line[0] = '-';
        if (line.starts_with("$$")) {
            if (!line.ends_with("$$") || line.size() < 5) throw std::logic_error("'" + line + "' lacks $$");
            line = "\n" + line.substr(1, line.size() - 2) + "\n";
        }
        lines += line + "\n";
    }
    std::vector<Block> blocks = blocks_of(messages_of(lines, "").front(), {});
    const auto require_questions = [](const Text& words) {
        for (const Run& run : words)
            if (run.kind == Run::Kind::reference && !is_question(run.content))
                throw std::logic_error("[[" + run.content + "]] is no question: write [[q5]], say");
    };
    for (const Block& block : blocks) {
        if (const auto* paragraph = std::get_if<Paragraph>(&block)) require_questions(paragraph->text);
        if (const auto* list = std::get_if<BulletList>(&block)) std::ranges::for_each(list->items, require_questions);
    }
    return blocks;
}

std::vector<std::string> facts_in(const Message& message) {
    std::set<std::string> names;
    for (const std::string& paragraph : message.paragraphs)
        for (std::size_t at = paragraph.find("{{"); at != std::string::npos; at = paragraph.find("{{", at + 2)) {
            const std::size_t begin = paragraph.find_first_not_of("{#^/", at);
            names.insert(paragraph.substr(begin, paragraph.find_first_of("|}", begin) - begin));
        }
    return {names.begin(), names.end()};
}

std::vector<Block> blocks_of(const Message& message, const Facts& facts) {
    std::vector<Block> blocks;
    for (const std::string_view paragraph : message.paragraphs) {
        if (paragraph.starts_with("### ")) {
            blocks.push_back(Heading{running_line(paragraph.substr(4), facts)});
        } else if (paragraph.starts_with("$$")) {
            const std::string inside = trimmed(paragraph.substr(2, paragraph.size() - 4));
            const std::size_t space = inside.find(' ');
            blocks.push_back(Formula{inside.substr(0, space), space == std::string::npos ? "" : trimmed(inside.substr(space))});
        } else if (paragraph.starts_with("- ")) {
            Text item = running_text(paragraph.substr(2), facts);
            if (blocks.empty() || !std::holds_alternative<BulletList>(blocks.back())) blocks.push_back(BulletList{});
            std::get<BulletList>(blocks.back()).items.push_back(std::move(item));
        } else {
            if (Text words = running_text(paragraph, facts); !words.empty()) blocks.push_back(Paragraph{std::move(words)});
        }
    }
    return blocks;
}

}   // namespace meshfolio::report
