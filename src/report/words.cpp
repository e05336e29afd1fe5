#include "report/words.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>

#include "base/errors.h"
#include "base/number_text.h"
#include "base/sha256.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

constexpr std::string_view folder = "words/", ending = ".md";

using MessagesByKey = std::map<std::string, Message, std::less<>>;
/// By file, then by key.
using Catalogue = std::map<std::string, MessagesByKey, std::less<>>;

MessagesByKey by_key(const std::string& text, const std::string& file) {
    MessagesByKey messages;
    for (Message& message : messages_of(text, file)) {
        const std::string key = message.key;
        const long line = message.line;
        if (!messages.emplace(key, std::move(message)).second)
            throw UsageError("the message " + key + " stands twice", "keep one", {file, line});
    }
    return messages;
}

Catalogue catalogue_of(const Templates& templates) {
    Catalogue catalogue;
    for (const std::string& name : templates.names()) {
        if (!name.starts_with(folder)) continue;
        catalogue[name.substr(folder.size(), name.size() - folder.size() - ending.size())] = by_key(templates[name], name);
    }
    return catalogue;
}

Catalogue& catalogue() {
    static Catalogue messages = catalogue_of(Templates());
    return messages;
}

std::string& identity() {
    static std::string of_replaced;
    return of_replaced;
}

const Message& message_of(std::string_view file, std::string_view key) {
    const auto messages = catalogue().find(file);
    const auto message = messages == catalogue().end() ? MessagesByKey::const_iterator() : messages->second.find(key);
    if (messages == catalogue().end() || message == messages->second.end())
        throw std::logic_error("templates/words/" + std::string(file) + ".md has no message " + std::string(key));
    return message->second;
}

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    return first == std::string_view::npos ? "" : std::string(text.substr(first, last - first + 1));
}

const Fact& fact_named(std::string_view name, const Facts& facts, std::string_view message) {
    const auto fact = std::ranges::find(facts, name, &Fact::name);
    if (fact == facts.end()) throw std::logic_error("the message '" + std::string(message) + "' lacks the fact " + std::string(name));
    return *fact;
}

/// The text for the placeholder "name" or "name|one|many".
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
    return std::get<Text>(fact.value);
}

/// Goes through one paragraph and makes runs of it.
class Reader {
public:
    Reader(std::string_view paragraph, const Facts& facts, bool markup)
        : all_(paragraph), left_(paragraph), facts_(facts), markup_(markup) {}

    Text text() {
        while (!left_.empty()) {
            if (take("\\") && !left_.empty()) {
                add(left_.substr(0, 1));
                left_.remove_prefix(1);
            } else if (take("{{")) {
                for (Run& run : filled(until("}}"), facts_, all_)) add(std::move(run));
            } else if (after_number() && take(" %")) {
                add("\u202f%");   // no line may break here, as in readable_percent
            } else if (!markup_ || !took_markup()) {
                add(left_.substr(0, 1));
                left_.remove_prefix(1);
            }
        }
        return std::move(text_);
    }

private:
    std::string_view all_, left_;
    const Facts& facts_;
    bool markup_;
    Text text_;

    bool take(std::string_view mark) {
        if (!left_.starts_with(mark)) return false;
        left_.remove_prefix(mark.size());
        return true;
    }

    bool after_number() const {
        return !text_.empty() && !text_.back().content.empty() && std::isdigit(static_cast<unsigned char>(text_.back().content.back()));
    }

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
        if (run.kind != Run::Kind::plain || !run.content.empty()) extend(text_, std::move(run));
    }
};

/// "$$ name id $$" and "$$ name $$".
Formula formula_in(std::string_view paragraph) {
    const std::string inside = trimmed(paragraph.substr(2, paragraph.size() - 4));
    const std::size_t space = inside.find(' ');
    return {inside.substr(0, space), space == std::string::npos ? "" : trimmed(std::string_view(inside).substr(space))};
}

std::string only_paragraph(const Message& message) {
    if (message.paragraphs.size() > 1) throw std::logic_error("the message " + message.key + " has several paragraphs");
    return message.paragraphs.empty() ? "" : message.paragraphs.front();
}

/// Checks that a replaced message can be formatted, instead of failing when it is first used.
void require_readable(const Message& message, const std::string& file) {
    Facts facts;
    const std::vector<std::string> names = facts_in(message);
    for (const std::string& name : names) facts.emplace_back(name, 1);
    try {
        for (const std::string& paragraph : message.paragraphs)
            if (!paragraph.starts_with("$$")) running_text(paragraph, facts);
    } catch (const std::logic_error& problem) {
        throw UsageError(problem.what(), "close every mark, or put a backslash before it", {file, message.line});
    }
}

/// The names behind which the message chooses between singular and plural.
std::set<std::string> counts_in(const Message& message) {
    static const std::regex plural("\\{\\{(\\w+)\\|");
    std::set<std::string> names;
    for (const std::string& paragraph : message.paragraphs)
        for (std::sregex_iterator it(paragraph.begin(), paragraph.end(), plural), end; it != end; ++it) names.insert((*it)[1]);
    return names;
}

/// Allows in a replaced message only the facts and plurals that the bundled message has.
void require_known_facts(const Message& message, const Message& own, const Location& place) {
    const auto require_among = [&](const auto& known, const auto& named, const std::string& problem) {
        for (const std::string& fact : named)
            if (std::ranges::find(known, fact) == known.end())
                throw UsageError("the message " + message.key + problem + fact, "name one of those that its own text has", place);
    };
    require_among(facts_in(own), facts_in(message), " is not told the fact ");
    require_among(counts_in(own), counts_in(message), " has no singular and plural of ");
}

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
            if (open && !alone && !item)
                paragraphs.back() += " " + words;
            else
                paragraphs.push_back(words);
            open = !alone;
        }
    }
    return messages;
}

Text running_text(std::string_view paragraph, const Facts& facts) { return Reader(paragraph, facts, true).text(); }

std::vector<std::string> facts_in(const Message& message) {
    std::set<std::string> names;
    for (const std::string& paragraph : message.paragraphs) {
        for (std::size_t at = paragraph.find("{{"); at != std::string::npos; at = paragraph.find("{{", at + 2))
            names.insert(paragraph.substr(at + 2, paragraph.find_first_of("|}", at) - at - 2));
    }
    return {names.begin(), names.end()};
}

Text Words::say(std::string_view key, const Facts& facts) const { return running_text(only_paragraph(message_of(file_, key)), facts); }

std::string Words::line(std::string_view key, const Facts& facts) const {
    const Message& message = message_of(file_, key);
    const std::string paragraph = only_paragraph(message);
    if (paragraph.find("[[") != std::string::npos)
        throw UsageError("the message " + message.key + " is a caption or a label, where a reference stays as it is written",
                         "take the [[…]] out", {std::string(folder) + std::string(file_) + std::string(ending), message.line});
    return plain(Reader(paragraph, facts, false).text());
}

std::vector<Block> Words::blocks(std::string_view key, const Facts& facts) const {
    std::vector<Block> blocks;
    for (const std::string_view paragraph : message_of(file_, key).paragraphs) {
        if (paragraph.starts_with("### ")) {
            blocks.push_back(Heading{plain(Reader(paragraph.substr(4), facts, false).text())});
        } else if (paragraph.starts_with("$$")) {
            blocks.push_back(formula_in(paragraph));
        } else if (paragraph.starts_with("- ")) {
            Text item = Reader(paragraph.substr(2), facts, true).text();
            if (blocks.empty() || !std::holds_alternative<BulletList>(blocks.back())) blocks.push_back(BulletList{});
            std::get<BulletList>(blocks.back()).items.push_back(std::move(item));
        } else {
            blocks.push_back(Paragraph{Reader(paragraph, facts, true).text()});
        }
    }
    return blocks;
}

void use_words_of(const Templates& templates) {
    const Templates bundled;
    const Catalogue own = catalogue_of(bundled);
    Catalogue told = own;
    for (const auto& [file, messages] : catalogue_of(templates)) {
        for (const auto& [key, message] : messages) {
            const auto known = own.at(file).find(key);
            const std::string name = std::string(folder) + file + std::string(ending);
            if (known == own.at(file).end()) throw UsageError("there is no message " + key, "take it out", {name, message.line});
            if (message.paragraphs == known->second.paragraphs) continue;
            require_known_facts(message, known->second, {name, message.line});
            require_readable(message, name);
            told[file][key] = message;
        }
    }
    catalogue() = std::move(told);
    identity().clear();
    for (const std::string& name : templates.names())
        if (name.starts_with(folder) && templates[name] != bundled[name]) identity() += name + sha256(templates[name]);
}

std::string words_identity() { return identity(); }

std::string words_documentation() {
    std::string text =
        "Words of the report, words/FILE.md: \"## key\" begins a message. {{fact}} is what the program found, {{count|one|many}} the word "
        "that\n"
        "goes with a count; $mathematics$, **strong**, *emphasised*, `code`, [[reference]]. What a message may tell:\n\n";
    for (const auto& [file, messages] : catalogue()) {
        for (const auto& [key, message] : messages) {
            text += file + ": " + key;
            for (const std::string& fact : facts_in(message)) text += " {{" + fact + "}}";
            text += "\n";
        }
    }
    return text;
}

}   // namespace meshfolio::report
