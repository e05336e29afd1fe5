#include "mesh/io/obj_gate.h"

#include <utility>

#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

using namespace std::string_view_literals;

// The statements in the description of the format (Wavefront, appendix B), old ones included, other than v, vt, vn and f.
// Names, materials and display: not needed for a triangle mesh.
constexpr std::array dropped{"g"sv,     "o"sv,        "s"sv,        "mg"sv,  "usemtl"sv,     "mtllib"sv,    "usemap"sv, "maplib"sv,
                             "bevel"sv, "c_interp"sv, "d_interp"sv, "lod"sv, "shadow_obj"sv, "trace_obj"sv, "vp"sv};
constexpr std::array free_form{"cstype"sv, "deg"sv,   "bmat"sv, "step"sv, "curv"sv, "curv2"sv, "surf"sv,
                               "parm"sv,   "trim"sv,  "hole"sv, "scrv"sv, "sp"sv,   "end"sv,   "con"sv,
                               "ctech"sv,  "stech"sv, "bsp"sv,  "bzp"sv,  "cdc"sv,  "cdp"sv,   "res"sv};
constexpr std::array commands{"csh"sv, "call"sv};   // would run a program or read another file

bool is_one_of(std::span<const std::string_view> names, std::string_view keyword) {
    return std::ranges::find(names, keyword) != names.end();
}

bool is_keyword(std::string_view word) {
    static constexpr std::array read{"v"sv, "vt"sv, "vn"sv, "f"sv, "fo"sv, "p"sv, "l"sv};
    return is_one_of(read, word) || is_one_of(dropped, word) || is_one_of(free_form, word) || is_one_of(commands, word);
}

/// Texture coordinates or normals. They are not used, but wrong indices are signs of a damaged file.
struct UnusedAttribute {
    const char* name;
    const char* one;
    const char* many;
    long long count = 0;
    /// Indices beyond the count so far, each larger than those before, with their lines. They are wrong unless enough follow.
    std::vector<std::pair<long long, long>> ahead;
};

class ObjGate {
public:
    ObjGate(std::string_view text, const std::string& file) : statements_(text), file_(file) { checked_.text.reserve(text.size() / 2); }

    CheckedObj run() {
        while (statements_.next()) {
            line_ = statements_.line();
            if (statements_.is_cut_off())
                checked_.warnings.add(line_, "line continuation at the end of the file", "line continuations at the end of the file");
            if (statements_.ends_before_keyword())
                checked_.warnings.add(line_, "\\ at the end of a line before a statement ignored",
                                      "lines that end in \\ before a statement, where it is ignored");
            std::string_view rest = statements_.text();
            const std::string_view keyword = take_word(rest);
            if (keyword == "v") vertex(rest);
            else if (keyword == "f" || keyword == "fo") face(rest);
            else if (keyword == "vt") ++texture_.count;
            else if (keyword == "vn") ++normal_.count;
            else other(keyword);
        }
        warn_of_missing(texture_);
        warn_of_missing(normal_);
        return std::move(checked_);
    }

private:
    Location here() const { return {file_, line_}; }

    /// Reads "v x y z" and the weight, the colour, or both that may follow.
    void vertex(std::string_view rest) {
        std::array<double, 7> value{};
        std::size_t count = 0;
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            const double x = checked_coordinate(word, file_, line_);
            if (count < value.size()) value[count] = x;
            ++count;
        }
        if (count < 3) throw InputError(here(), "'v' needs 3 coordinates, has " + std::to_string(count), "the line may be cut off");
        if (count == 5 || count > value.size())
            checked_.warnings.add(line_, "extra numbers on a vertex ignored", "vertices with extra numbers, which are ignored");
        if (count == 4 && value[3] != 1)
            checked_.warnings.add(line_, "vertex weight other than 1 ignored", "vertex weights other than 1 ignored");
        checked_.coordinates.insert(checked_.coordinates.end(), value.begin(), value.begin() + 3);
        if (count != 6 && count != 7) return;
        checked_.colors.insert(checked_.colors.end(), value.begin() + static_cast<int>(count) - 3, value.begin() + static_cast<int>(count));
        checked_.colored.push_back(static_cast<int>(checked_.coordinates.size() / 3) - 1);
    }

    void face(std::string_view rest) {
        const std::size_t begin = checked_.text.size();
        checked_.text += 'f';
        int corners = 0;
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            checked_.text.append(" ").append(std::to_string(corner(word)));
            ++corners;
        }
        checked_.text += '\n';
        if (corners >= 3) return checked_.face_lines.push_back(line_);
        checked_.text.resize(begin);
        checked_.warnings.add(line_, "face with fewer than 3 vertices ignored", "faces with fewer than 3 vertices ignored");
    }

    /// Returns the vertex (counted from 1) of a corner v, v/vt, v//vn or v/vt/vn.
    int corner(std::string_view word) {
        const std::size_t slash = word.find('/');
        if (slash == std::string_view::npos) return vertex_index(word);
        const std::string_view attributes = word.substr(slash + 1);
        const std::size_t second = attributes.find('/');
        const std::string_view vt = attributes.substr(0, second);
        if (second == std::string_view::npos) {
            attribute_index(texture_, vt, word);
        } else {
            if (second > 0) attribute_index(texture_, vt, word);
            attribute_index(normal_, attributes.substr(second + 1), word);
        }
        return vertex_index(word.substr(0, slash));
    }

    int vertex_index(std::string_view word) const {
        const auto vertices = static_cast<long long>(checked_.coordinates.size() / 3);
        const std::optional<long long> index = parse_integer(word);
        const bool from_end = index && *index < 0;
        if (index && *index > 0 && *index <= std::numeric_limits<int>::max()) return static_cast<int>(*index);
        if (from_end && *index >= -vertices) return static_cast<int>(vertices + *index + 1);
        throw InputError(here(), "vertex index " + in_quotes(word) + " is not a valid index (" + vertex_count(vertices) + " so far)",
                         from_end ? "it reaches before the first vertex" : "indices are whole numbers from 1");
    }

    void attribute_index(UnusedAttribute& attribute, std::string_view word, std::string_view whole) {
        const std::optional<long long> index = parse_integer(word);
        if (!index) throw InputError(here(), "bad face corner " + in_quotes(whole), "corners are v, v/vt, v//vn or v/vt/vn");
        if (*index == 0 || *index < -attribute.count) checked_.warnings.add(line_, attribute.one, attribute.many, std::to_string(*index));
        else if (*index > attribute.count && (attribute.ahead.empty() || *index > attribute.ahead.back().first))
            attribute.ahead.emplace_back(*index, line_);
    }

    void warn_of_missing(const UnusedAttribute& attribute) {
        const auto wrong = [&](const auto& ahead) { return ahead.first > attribute.count; };
        const auto first = std::find_if(attribute.ahead.begin(), attribute.ahead.end(), wrong);
        if (first == attribute.ahead.end()) return;
        const std::string names(attribute.name, std::string_view(attribute.name).size() - (attribute.count == 1 ? 1 : 0));
        checked_.warnings.add(first->second, attribute.one, attribute.many,
                              std::to_string(first->first) + ", the file has " + std::to_string(attribute.count) + " " + names);
    }

    void other(std::string_view keyword) {
        WarningTally& warnings = checked_.warnings;
        if (is_one_of(dropped, keyword)) return;
        if (keyword == "p" || keyword == "l") {
            warnings.add(line_, "point or line element ignored", "point or line elements ignored");
        } else if (is_one_of(free_form, keyword)) {
            checked_.free_form = true;
            warnings.add(line_, "free-form statement ignored", "free-form statements ignored", in_quotes(keyword));
        } else if (is_one_of(commands, keyword)) {
            warnings.add(line_, "command statement ignored", "command statements ignored", in_quotes(keyword));
        } else {
            warnings.add(line_, "unknown statement ignored", "unknown statements ignored", in_quotes(keyword));
            if (checked_.unknown.empty()) checked_.unknown = in_quotes(keyword) + " at line " + std::to_string(line_);
        }
    }

    ObjStatements statements_;
    const std::string& file_;
    long line_ = 0;   // where the statement begins
    UnusedAttribute texture_{"texture coordinates", "texture index ignored", "texture indices ignored", 0, {}};
    UnusedAttribute normal_{"normals", "normal index ignored", "normal indices ignored", 0, {}};
    CheckedObj checked_;
};

bool ends_in_backslash(std::string_view line) {
    const std::size_t last = line.find_last_not_of(" \t");
    return last != std::string_view::npos && line[last] == '\\';
}

std::string_view without_backslash(std::string_view line) { return line.substr(0, line.find_last_of('\\')); }

}   // namespace

bool ObjStatements::next() {
    ends_before_keyword_ = false;
    if (!lines_.next_with_words()) return false;
    line_ = lines_.number();
    statement_ = lines_.line();
    begin_ = static_cast<std::size_t>(statement_.data() - start_);
    if (!ends_in_backslash(statement_)) return true;
    std::string_view first = without_backslash(statement_);
    const std::string_view keyword = take_word(first);
    const bool is_read = keyword == "v" || keyword == "f" || keyword == "fo";
    joined_.clear();
    std::string_view part = statement_;
    while (ends_in_backslash(part)) {
        joined_.append(without_backslash(part)).push_back(' ');
        LineScanner following = lines_;
        cut_off_ = !following.next();
        part = cut_off_ ? std::string_view() : without_comment(following.line());
        std::string_view words = ends_in_backslash(part) ? without_backslash(part) : part;
        ends_before_keyword_ = !is_read && is_keyword(take_word(words));
        if (ends_before_keyword_) part = {};
        if (cut_off_ || ends_before_keyword_) break;
        lines_ = following;
    }
    statement_ = joined_.append(part);
    return true;
}

CheckedObj check_obj(std::string_view text, const std::string& file) {
    refuse_nul_bytes(text, file);
    return ObjGate(without_bom(text), file).run();
}

}   // namespace meshfolio
