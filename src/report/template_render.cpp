#include "report/template_render.h"

#include <algorithm>
#include <map>
#include <mustache.hpp>
#include <nlohmann/json.hpp>
#include <string_view>
#include <unordered_map>

#include "errors.h"

namespace meshfolio::report {

namespace {

namespace mustache = kainjow::mustache;
using nlohmann::json;
using Component = mustache::component<std::string>;

long line_of(const std::string& text, std::size_t position) {
    const std::size_t end = std::min(position, text.size());
    return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
}

/// The tree of a template; `error` says "… at <position>" when there is none.
Component parsed(const std::string& text, std::string& error) {
    mustache::context<std::string> nothing;
    mustache::context_internal<std::string> context(nothing);
    Component root;
    const mustache::parser<std::string> parser(text, context, root, error);
    return root;
}

/// An included template does not bring its last line end along: it may stand within a line.
std::string as_partial(std::string text) {
    if (text.ends_with('\n')) text.pop_back();
    return text;
}

// ---- a template evaluated against a model ---------------------------------------------------------------------------------

using Escape = std::function<std::string(const std::string&)>;

/// What is printed, line by line: a line that is blank but for sections that begin or end on it is left out.
class Lines {
public:
    void add(const std::string& text) { line_ += text; }
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
        if (++depth_ > 100) throw UsageError("the template includes itself without end", "", {name, 0});
        auto it = trees_.find(name);
        if (it == trees_.end()) {
            std::string error;
            it = trees_.emplace(name, parsed(depth_ > 1 ? as_partial(templates_[name]) : templates_[name], error)).first;
            register_tags(name, it->second);
        }
        walk(it->second);
        --depth_;
    }

    std::string printed() {
        lines_.end("");
        return lines_.take();
    }

    /// The tags in one of the two states that are worth telling, in the order of their places; the map has none.
    std::vector<Tag> unknown() const { return tags_in(State::unknown); }
    std::vector<Tag> unreached() const { return tags_in(State::unreached); }

private:
    enum class State { unreached, known, unknown };
    struct Registered {
        std::string file;
        State state = State::unreached;
    };

    std::vector<Tag> tags_in(State state) const {
        std::vector<Tag> tags;
        for (const auto& [component, tag] : tags_) {
            if (tag.state != state) continue;
            tags.push_back({tag.file, line_of(templates_[tag.file], component->position), component->position, component->tag.name});
        }
        std::sort(tags.begin(), tags.end());
        return tags;
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

    void walk(const Component& component) {
        for (const Component& child : component.children) {
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
    int depth_ = 0;
};

}   // namespace

std::optional<SyntaxProblem> syntax_problem(const std::string& text) {
    std::string error;
    parsed(text, error);
    if (error.empty()) return {};
    const std::size_t at = error.rfind(" at ");
    return SyntaxProblem{error.substr(0, at), line_of(text, std::stoul(error.substr(at + 4)))};
}

TagUse use_of_tags(const Templates& templates, const std::string& name, const json& model) {
    TagWalk walk(templates, model);
    walk.walk_file(name);
    return {walk.unknown(), walk.unreached()};
}

std::string render(const Templates& templates, const std::string& name, const json& model,
                   const std::function<std::string(const std::string&)>& escape) {
    TagWalk walk(templates, model, escape);
    walk.walk_file(name);
    if (const std::vector<Tag> unknown = walk.unknown(); !unknown.empty()) {
        const Tag& tag = unknown.front();
        throw UsageError("nothing is called {{" + tag.name + "}} here", "compare it with the template that comes with meshfolio",
                         {tag.file, tag.line});
    }
    return walk.printed();
}

}   // namespace meshfolio::report
