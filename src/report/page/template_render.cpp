#include "report/page/template_render.h"

#include <algorithm>
#include <map>
#include <mustache.hpp>
#include <nlohmann/json.hpp>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "report/json/json_line.h"

namespace meshfolio::report {

namespace {

namespace mustache = kainjow::mustache;
using nlohmann::json;
using Component = mustache::component<std::string>;

constexpr std::size_t longest_name = 200;   // of a tag in a message

/// The tree of a template; `error` says "… at <position>" when there is none.
Component parsed(const std::string& text, std::string& error) {
    mustache::context<std::string> nothing;
    mustache::context_internal<std::string> context(nothing);
    Component root;
    const mustache::parser<std::string> parser(text, context, root, error);
    return root;
}

/// Limits nesting before parsing: the parser copies the text of every section and recurses.
std::optional<SyntaxProblem> nesting_problem(const std::string& text) {
    int depth = 0;
    for (std::size_t at = text.find("{{"), end = 0; at != std::string::npos; at = text.find("{{", end)) {
        const bool is_triple = text.compare(at, 3, "{{{") == 0;
        const std::string_view close = is_triple ? "}}}" : "}}";
        end = text.find(close, at + close.size());
        if (end == std::string::npos) break;   // the parser reports it
        const std::size_t first = text.find_first_not_of(" \t\r\n", at + 2);
        end += close.size();
        if (is_triple) continue;
        if (text[first] == '=') return SyntaxProblem{"the delimiters of tags cannot be changed", line_of_byte(text, at)};
        if (text[first] == '/') --depth;
        if ((text[first] == '#' || text[first] == '^') && ++depth > template_limits::deepest_sections) {
            return SyntaxProblem{"more than " + std::to_string(template_limits::deepest_sections) + " sections within one another",
                                 line_of_byte(text, at)};
        }
    }
    return {};
}

/// An included template does not bring its last line end along: it may stand within a line.
std::string as_partial(std::string text) {
    if (text.ends_with('\n')) text.pop_back();
    return text;
}

// ---- a template evaluated against a model ---------------------------------------------------------------------------------

using Escape = std::function<std::string(const std::string&)>;

/// Collects the output line by line and drops lines that hold nothing but section tags.
class Lines {
public:
    void add(const std::string& text) { line_ += text; }
    std::size_t size() const { return text_.size() + line_.size(); }
    void section_tag() { has_section_tag_ = true; }
    void end(const std::string& line_end) {
        const bool left_out = has_section_tag_ && line_.find_first_not_of(" \t") == std::string::npos;
        if (!left_out) text_ += line_ + line_end;
        line_.clear();
        has_section_tag_ = false;
    }
    std::string take() { return std::move(text_); }

private:
    std::string text_, line_;
    bool has_section_tag_ = false;
};

/// Goes through a template as Mustache says. The library parses; it would copy the whole model into values of its own and parse included
/// templates each time they are met, which took most of the time of a report whose answers are all known.
class TagWalk {
public:
    TagWalk(const Templates& templates, const json& model, Escape escape = {})
        : templates_(templates), escape_(std::move(escape)), stack_{&model} {}

    void walk_file(const std::string& name) {
        if (++depth_ > template_limits::deepest_includes) {
            throw UsageError("templates include one another more than " + std::to_string(template_limits::deepest_includes) + " deep",
                             "one that includes itself never ends", {name, 0});
        }
        const std::string_view includer = std::exchange(file_, name);
        auto it = trees_.find(name);
        if (it == trees_.end() && depth_ > 1) require_known(name, std::string(includer));
        if (it == trees_.end()) {
            std::string error;
            it = trees_.emplace(name, parsed(depth_ > 1 ? as_partial(templates_[name]) : templates_[name], error)).first;
            register_tags(name, it->second);
        }
        walk(it->second);
        --depth_;
        file_ = includer;
    }

    std::string printed() {
        lines_.end("");
        return lines_.take();
    }

    TagUse result() const {
        TagUse use;
        for (const auto& [component, tag] : tags_) {
            if (tag.state == State::known) continue;
            const Tag named{tag.file, 0, component->position, component->tag.name};
            (tag.state == State::unknown ? use.unknown : use.unreached).push_back(named);
        }
        for (std::vector<Tag>* tags : {&use.unknown, &use.unreached}) {
            std::sort(tags->begin(), tags->end());   // the map has no order
            find_lines(*tags);
        }
        return use;
    }

private:
    void require_known(const std::string& name, const std::string& includer) const {
        const std::vector<std::string> known = templates_.names();
        if (std::find(known.begin(), known.end(), name) != known.end()) return;
        throw UsageError("{{>" + name + "}} includes what is no template", "did you mean '" + nearest_word(name, known) + "'?",
                         {includer, 0});
    }

    enum class State { unreached, known, unknown };
    struct Registered {
        std::string file;
        State state = State::unreached;
    };

    /// Sets the lines of tags sorted by position, scanning each text once.
    void find_lines(std::vector<Tag>& tags) const {
        const Tag* before = nullptr;
        for (Tag& tag : tags) {
            const bool goes_on = before != nullptr && before->file == tag.file;
            const std::string_view text = std::string_view(templates_[tag.file]).substr(0, tag.position);
            const std::string_view between = text.substr(goes_on ? std::min(before->position, text.size()) : 0);
            tag.line = (goes_on ? before->line : 1) + std::count(between.begin(), between.end(), '\n');
            before = &tag;
        }
    }

    static bool is_looked_up(const Component& c) {
        using Type = mustache::tag_type;
        const Type type = c.tag.type;
        return type == Type::variable || type == Type::unescaped_variable || c.tag.is_section_begin();
    }

    void register_tags(const std::string& file, const Component& component) {
        for (const Component& child : component.children) {
            if (is_looked_up(child)) tags_[&child] = {file};
            register_tags(file, child);
        }
    }

    /// As Mustache looks a name up: from the innermost context outwards.
    const json* find(const std::string& name) const {
        if (name == ".") return stack_.back();
        for (auto context = stack_.rbegin(); context != stack_.rend(); ++context) {
            const json* value = *context;
            for (std::size_t begin = 0; value && begin <= name.size();) {
                const std::size_t end = std::min(name.find('.', begin), name.size());
                const auto member = value->is_object() ? value->find(std::string_view(name).substr(begin, end - begin)) : value->end();
                value = value->is_object() && member != value->end() ? &*member : nullptr;
                begin = end + 1;
            }
            if (value) return value;
        }
        return nullptr;
    }

    /// Limits steps and output: nested lists could run practically forever.
    void take_step() {
        const bool too_long = ++steps_ > template_limits::most_steps;
        if (!too_long && lines_.size() <= template_limits::largest_print) return;
        throw UsageError(too_long ? "the template takes more than " + std::to_string(template_limits::most_steps) + " steps"
                                  : "the template prints more than " + std::to_string(template_limits::largest_print) + " bytes",
                         "does it repeat a list within itself?", {std::string(file_), 0});
    }

    void walk(const Component& component) {
        for (const Component& child : component.children) {
            take_step();
            if (child.is_newline()) {
                lines_.end(child.text);
            } else if (child.is_text()) {
                lines_.add(child.text);
            }
            if (child.tag.type == mustache::tag_type::partial) walk_file(child.tag.name);
            if (!is_looked_up(child)) continue;
            const json* value = find(child.tag.name);
            State& state = tags_[&child].state;
            if (state != State::unknown) state = value ? State::known : State::unknown;
            if (value == nullptr) continue;
            if (child.tag.is_section_begin()) {
                walk_section(child, *value);
            } else {
                print(*value, child.tag.type == mustache::tag_type::variable);
            }
        }
    }

    /// Texts as they are or escaped, numbers; lists, objects and booleans have nothing to print.
    void print(const json& value, bool escaped) {
        if (value.is_string()) {
            const auto& text = value.get_ref<const std::string&>();
            lines_.add(escaped && escape_ ? escape_(text) : text);
        } else if (value.is_number()) {
            lines_.add(value.dump());
        }
    }

    void walk_section(const Component& section, const json& value) {
        const bool empty = value == false || (value.is_array() && value.empty());
        const bool inverted = section.tag.type == mustache::tag_type::section_begin_inverted;
        if (empty != inverted) return;
        if (!value.is_array() || inverted) {
            walk_in(section, value);
        } else {
            for (const json& item : value) walk_in(section, item);
        }
    }

    void walk_in(const Component& section, const json& value) {
        take_step();   // of each item: a section may be empty
        lines_.section_tag();
        stack_.push_back(&value);
        walk(section);
        stack_.pop_back();
        lines_.section_tag();
    }

    const Templates& templates_;
    Escape escape_;
    Lines lines_;
    std::vector<const json*> stack_;
    std::map<std::string, Component> trees_;
    std::unordered_map<const Component*, Registered> tags_;
    std::string_view file_;   // that is being evaluated
    int depth_ = 0;
    long long steps_ = 0;
};

}   // namespace

std::optional<SyntaxProblem> syntax_problem(const std::string& text) {
    if (auto problem = nesting_problem(text)) return problem;
    std::string error;
    parsed(text, error);
    if (error.empty()) return {};
    const std::size_t at = error.rfind(" at ");
    return SyntaxProblem{error.substr(0, at), line_of_byte(text, std::stoul(error.substr(at + 4)))};
}

TagUse use_of_tags(const Templates& templates, const std::string& name, const json& model) {
    TagWalk walk(templates, model);
    walk.walk_file(name);
    return walk.result();
}

std::string render(const Templates& templates, const std::string& name, const json& model,
                   const std::function<std::string(const std::string&)>& escape) {
    TagWalk walk(templates, model, escape);
    walk.walk_file(name);
    const TagUse use = walk.result();
    if (!use.unknown.empty()) {
        const Tag& tag = use.unknown.front();
        throw UsageError("nothing is called {{" + tag.name.substr(0, longest_name) + "}} here",
                         "compare it with the template that comes with meshfolio", {tag.file, tag.line});
    }
    return walk.printed();
}

}   // namespace meshfolio::report
