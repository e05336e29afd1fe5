#include "report/page/template_render.h"

#include <algorithm>
#include <map>
#include <mustache.hpp>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "report/json/json_line.h"

namespace meshfolio::report {

namespace {

namespace mustache = kainjow::mustache;
using nlohmann::json;
using Component = mustache::component<std::string>;

constexpr std::size_t longest_name = 200;   // of a tag in a message

/// Returns the tree of a template. On a syntax error `error` becomes "… at <position>".
Component parsed(const std::string& text, std::string& error) {
    mustache::context<std::string> nothing;
    mustache::context_internal<std::string> context(nothing);
    Component root;
    const mustache::parser<std::string> parser(text, context, root, error);
    return root;
}

/// Refuses deep nesting before the parser runs, which copies the text of every section and recurses.
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

/// Evaluates templates against a view model. The library only parses: its own renderer would copy the whole model and parse included
/// templates each time, which took most of the time of a report from cached answers.
class Renderer {
public:
    Renderer(const Templates& templates, const json& model, const std::function<std::string(const std::string&)>& escape)
        : templates_(templates), escape_(escape), stack_{&model} {}

    void render_file(const std::string& name) {
        if (++depth_ > template_limits::deepest_includes) {
            throw UsageError("templates include one another more than " + std::to_string(template_limits::deepest_includes) + " deep",
                             "take out the {{>…}} by which one includes itself", {name, 0});
        }
        const std::string_view includer = std::exchange(file_, name);
        auto it = trees_.find(name);
        if (it == trees_.end()) {
            const std::vector<std::string> known = templates_.names();
            if (std::ranges::find(known, name) == known.end())
                throw UsageError("{{>" + name + "}} includes no known template", "did you mean '" + nearest_word(name, known) + "'?",
                                 {std::string(includer), 0});
            std::string text = templates_[name], error;
            if (depth_ > 1 && text.ends_with('\n')) text.pop_back();   // it may be included within a line
            it = trees_.emplace(name, parsed(text, error)).first;
        }
        render_children(it->second);
        --depth_;
        file_ = includer;
    }

    std::string printed() {
        lines_.end("");
        return lines_.take();
    }

private:
    /// Returns the value of a name, looked up from the innermost context outwards as in Mustache; null if the model lacks it.
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

    /// Limits steps and output, as nested lists could run practically forever.
    void take_step() {
        const bool too_long = ++steps_ > template_limits::most_steps;
        if (!too_long && lines_.size() <= template_limits::largest_print) return;
        throw UsageError(too_long ? "the template takes more than " + std::to_string(template_limits::most_steps) + " steps"
                                  : "the template prints more than " + std::to_string(template_limits::largest_print) + " bytes",
                         "take out a list that is repeated within itself", {std::string(file_), 0});
    }

    [[noreturn]] void refuse(const Component& tag) const {
        const std::string file(file_);
        throw UsageError("nothing is called {{" + tag.tag.name.substr(0, longest_name) + "}} here",
                         "compare it with the template that comes with meshfolio", {file, line_of_byte(templates_[file], tag.position)});
    }

    void render_children(const Component& component) {
        using Type = mustache::tag_type;
        for (const Component& child : component.children) {
            take_step();
            const Type type = child.tag.type;
            if (child.is_newline()) {
                lines_.end(child.text);
            } else if (child.is_text()) {
                lines_.add(child.text);
            }
            if (type == Type::partial) render_file(child.tag.name);
            const bool is_section = child.tag.is_section_begin();
            if (!is_section && type != Type::variable && type != Type::unescaped_variable) continue;
            const json* value = find(child.tag.name);
            if (value == nullptr) refuse(child);
            if (is_section) {
                render_section(child, *value);
            } else if (value->is_string()) {   // lists, objects and booleans print nothing
                const auto& text = value->get_ref<const std::string&>();
                lines_.add(type == Type::variable ? escape_(text) : text);
            } else if (value->is_number()) {
                lines_.add(value->dump());
            }
        }
    }

    void render_section(const Component& section, const json& value) {
        const bool empty = value == false || (value.is_array() && value.empty());
        const bool inverted = section.tag.type == mustache::tag_type::section_begin_inverted;
        if (empty != inverted) return;
        const auto render_with = [&](const json& item) {
            take_step();   // the section itself may have no children
            lines_.section_tag();
            stack_.push_back(&item);
            render_children(section);
            stack_.pop_back();
            lines_.section_tag();
        };
        if (!value.is_array() || inverted) {
            render_with(value);
        } else {
            std::ranges::for_each(value, render_with);
        }
    }

    const Templates& templates_;
    const std::function<std::string(const std::string&)>& escape_;
    Lines lines_;
    std::vector<const json*> stack_;
    std::map<std::string, Component> trees_;
    std::string_view file_;   // being evaluated
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

std::string render(const Templates& templates, const std::string& name, const json& model,
                   const std::function<std::string(const std::string&)>& escape) {
    Renderer renderer(templates, model, escape);
    renderer.render_file(name);
    return renderer.printed();
}

}   // namespace meshfolio::report
