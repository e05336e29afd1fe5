#include "report/template_render.h"

#include <algorithm>
#include <map>
#include <mustache.hpp>
#include <nlohmann/json.hpp>

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

// ---- nlohmann → mustache ------------------------------------------------------------------------------------------------

mustache::data data_of(const json& value) {
    if (value.is_boolean()) return mustache::data(value.get<bool>());
    if (value.is_string()) return mustache::data(value.get_ref<const std::string&>());
    if (value.is_array()) {
        mustache::list items;
        for (const json& item : value) items.push_back(data_of(item));
        return mustache::data(items);
    }
    if (!value.is_object()) return mustache::data(value.dump());
    mustache::data object(mustache::data::type::object);
    for (const auto& [name, member] : value.items()) object[name] = data_of(member);
    return object;
}

// ---- which tags a template uses -----------------------------------------------------------------------------------------

class TagWalk {
public:
    TagWalk(const Templates& templates, const json& model) : templates_(templates), stack_{&model} {}

    void walk_file(const std::string& name) {
        if (++depth_ > 100) throw UsageError("the template includes itself without end", "", {name, 0});
        auto it = trees_.find(name);
        if (it == trees_.end()) {
            std::string error;
            it = trees_.emplace(name, parsed(as_partial(templates_[name]), error)).first;
            register_tags(name, it->second);
        }
        walk(it->second);
        --depth_;
    }

    TagUse result() const {
        TagUse use;
        for (const auto& [component, tag] : tags_) {
            if (tag.state == State::known) continue;
            const Tag named{tag.file, line_of(templates_[tag.file], component->position), component->position, component->tag.name};
            (tag.state == State::unknown ? use.unknown : use.unreached).push_back(named);
        }
        std::sort(use.unknown.begin(), use.unknown.end());   // the map is ordered by addresses
        std::sort(use.unreached.begin(), use.unreached.end());
        return use;
    }

private:
    enum class State { unreached, known, unknown };
    struct Registered {
        std::string file;
        State state = State::unreached;
    };

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
                const auto member = value->is_object() ? value->find(name.substr(begin, end - begin)) : value->end();
                value = value->is_object() && member != value->end() ? &*member : nullptr;
                begin = end + 1;
            }
            if (value) return value;
        }
        return nullptr;
    }

    void walk(const Component& component) {
        for (const Component& child : component.children) {
            if (child.tag.type == mustache::tag_type::partial) walk_file(child.tag.name);
            if (!is_looked_up(child)) continue;
            const json* value = find(child.tag.name);
            State& state = tags_[&child].state;
            if (state != State::unknown) state = value ? State::known : State::unknown;
            if (value && child.tag.is_section_begin()) walk_section(child, *value);
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
        stack_.push_back(&value);
        walk(section);
        stack_.pop_back();
    }

    const Templates& templates_;
    std::vector<const json*> stack_;
    std::map<std::string, Component> trees_;
    std::map<const Component*, Registered> tags_;
    int depth_ = 0;
};

/// Names of the templates included by `text`, and by those.
void collect_partials(const Templates& templates, const std::string& text, std::map<std::string, std::string>& partials) {
    std::string error;
    Component root = parsed(text, error);
    root.walk_children([&](Component& c) {
        if (c.tag.type == mustache::tag_type::partial && !partials.contains(c.tag.name)) {
            const std::string& included = partials[c.tag.name] = as_partial(templates[c.tag.name]);
            collect_partials(templates, included, partials);
        }
        return Component::walk_control::walk;
    });
}

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
    return walk.result();
}

std::string render(const Templates& templates, const std::string& name, const json& model,
                   const std::function<std::string(const std::string&)>& escape) {
    const TagUse use = use_of_tags(templates, name, model);
    if (!use.unknown.empty()) {
        const Tag& tag = use.unknown.front();
        throw UsageError("nothing is called {{" + tag.name + "}} here", "compare it with the template that comes with meshfolio",
                         {tag.file, tag.line});
    }
    mustache::data data = data_of(model);
    std::map<std::string, std::string> partials;
    collect_partials(templates, templates[name], partials);
    for (const auto& [partial, text] : partials) data[partial] = mustache::data(text);
    mustache::mustache page(templates[name]);
    page.set_custom_escape(escape);
    std::string bytes;
    page.render(data, [&](const std::string& piece) { bytes += piece; });
    return bytes;
}

}   // namespace meshfolio::report
