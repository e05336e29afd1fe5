#include "mesh/io/ply_header.h"

#include <set>
#include <utility>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

constexpr std::pair<std::string_view, ScalarType> type_names[] = {
    {"char", ScalarType::int8},   {"uchar", ScalarType::uint8},   {"short", ScalarType::int16},     {"ushort", ScalarType::uint16},
    {"int", ScalarType::int32},   {"uint", ScalarType::uint32},   {"float", ScalarType::float32},   {"double", ScalarType::float64},
    {"int8", ScalarType::int8},   {"uint8", ScalarType::uint8},   {"int16", ScalarType::int16},     {"uint16", ScalarType::uint16},
    {"int32", ScalarType::int32}, {"uint32", ScalarType::uint32}, {"float32", ScalarType::float32}, {"float64", ScalarType::float64},
};

class HeaderReader {
public:
    HeaderReader(std::string_view bytes, const std::string& file) : bytes_(bytes), lines_(bytes), file_(file) {}

    PlyHeader run() {
        if (!lines_.next() || lines_.line() != "ply") fail(1, "no 'ply' on the first line", "is this a mesh in PLY format?");
        const bool only_returns = bytes_.substr(3).starts_with('\r') && !bytes_.substr(3).starts_with("\r\n");
        for (bool in_header = true; in_header;) {
            if (!lines_.next()) fail(0, "ends early: no end_header", "the file may be cut off");
            std::string_view rest = lines_.line();
            const std::string_view keyword = take_word(rest);
            if (keyword == "end_header") in_header = false;
            else if (keyword == "format") read_format(rest);
            else if (keyword == "element") read_element(rest);
            else if (keyword == "property") read_property(rest);
            else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty())
                fail(lines_.number(), "unknown header line " + in_quotes(lines_.line()), "is end_header missing?");
        }
        if (!has_format_) fail(0, "no format line", "the second line should be 'format ascii 1.0' or a binary one");
        header_.size = lines_.offset();
        header_.lines = lines_.number();
        // If lines end in \r alone, a \n behind the last one is the first byte of the data.
        if (only_returns && bytes_.substr(0, header_.size).ends_with("\r\n")) --header_.size;
        check_counts();
        return std::move(header_);
    }

private:
    [[noreturn]] void fail(long line, const std::string& problem, const std::string& remedy) const {
        throw InputError({file_, line}, problem, remedy);
    }

    void read_format(std::string_view rest) {
        if (has_format_) fail(lines_.number(), "a second format line", second_remedy);
        const std::string_view name = take_word(rest);
        const std::string_view version = take_word(rest);
        if (version != "1.0") fail(lines_.number(), "PLY version " + in_quotes(version) + " is not supported", "the version is 1.0");
        if (name == "ascii") header_.format = PlyHeader::Format::ascii;
        else if (name == "binary_little_endian") header_.format = PlyHeader::Format::little_endian;
        else if (name == "binary_big_endian") header_.format = PlyHeader::Format::big_endian;
        else fail(lines_.number(), "unknown format " + in_quotes(name), "formats are ascii, binary_little_endian, binary_big_endian");
        has_format_ = true;
    }

    void read_element(std::string_view rest) {
        const std::string_view name = take_word(rest);
        const std::string_view word = take_word(rest);
        const std::optional<long long> count = parse_integer(word);
        if (!count || *count < 0 || *count > std::numeric_limits<int>::max())
            fail(lines_.number(), "impossible count " + in_quotes(word) + " of element " + in_quotes(name),
                 "counts are whole numbers from 0 to " + std::to_string(std::numeric_limits<int>::max()));
        if (!elements_.emplace(name).second) fail(lines_.number(), "element " + in_quotes(name) + " a second time", second_remedy);
        properties_.clear();
        header_.elements.push_back({std::string(name), *count, lines_.number(), {}});
    }

    void read_property(std::string_view rest) {
        if (header_.elements.empty()) fail(lines_.number(), "property outside an element", "an element line must come first");
        PlyProperty property;
        property.line = lines_.number();
        std::string_view word = take_word(rest);
        if (word == "list") {
            property.is_list = true;
            property.count_type = type_named(take_word(rest));
            if (!is_integer(property.count_type)) fail(lines_.number(), "list count type must be an integer type", "such as uchar");
            word = take_word(rest);
        }
        property.type = type_named(word);
        property.name = take_word(rest);
        if (property.name.empty()) fail(lines_.number(), "property without a name", "the header may be damaged");
        PlyElement& element = header_.elements.back();
        if (!properties_.insert(property.name).second)
            fail(lines_.number(), "property " + in_quotes(property.name) + " of element " + in_quotes(element.name) + " a second time",
                 second_remedy);
        element.properties.push_back(std::move(property));
    }

    ScalarType type_named(std::string_view word) const {
        const auto type = std::find_if(std::begin(type_names), std::end(type_names), [&](auto& t) { return t.first == word; });
        if (type == std::end(type_names))
            fail(lines_.number(), "unknown type " + in_quotes(word), "types are char, uchar, … float, double");
        return type->second;
    }

    void check_counts() const {
        std::size_t left = bytes_.size() - header_.size + 1;   // the last line end may be missing
        for (const PlyElement& element : header_.elements) {
            if (element.count > 0 && element.properties.empty())
                fail(element.line, "element " + in_quotes(element.name) + " has no properties", "the header may be damaged");
            std::size_t row = 0;   // at least: in a binary file its values and list lengths, in text a digit and a separator each
            for (const PlyProperty& p : element.properties)
                row += header_.format == PlyHeader::Format::ascii ? 2 : size_of(p.is_list ? p.count_type : p.type);
            const auto count = static_cast<std::size_t>(element.count);
            if (count > 0 && count > left / row)
                fail(element.line,
                     "ends early: impossible count, " + std::to_string(count) + " of element " + in_quotes(element.name) + " with " +
                         std::to_string(bytes_.size() - header_.size) + " bytes of data",
                     "the file may be cut off");
            left -= count * row;
        }
    }

    static constexpr char second_remedy[] = "which of the two holds cannot be known; export the mesh again";

    std::string_view bytes_;
    LineScanner lines_;
    const std::string& file_;
    bool has_format_ = false;
    std::set<std::string> elements_, properties_;   // names met; properties are those of the last element
    PlyHeader header_;
};

[[noreturn]] void fail(const std::string& file, long line, const std::string& problem, const std::string& remedy) {
    throw InputError({file, line}, problem, remedy);
}

/// Returns the element or property named `name`, or null.
template <class Named> const Named* named(const std::vector<Named>& list, std::string_view name) {
    const auto found = std::ranges::find_if(list, [&](const Named& entry) { return entry.name == name; });
    return found == list.end() ? nullptr : &*found;
}

}   // namespace

std::string_view ply_name_of(ScalarType type) {
    return std::find_if(std::begin(type_names), std::end(type_names), [&](auto& t) { return t.second == type; })->first;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& file) { return HeaderReader(bytes, file).run(); }

PlyMeshParts mesh_parts(const PlyHeader& header, const std::string& file) {
    PlyMeshParts parts{};
    parts.vertices = named(header.elements, "vertex");
    if (parts.vertices == nullptr) fail(file, 0, "no vertex element", "export the mesh with its vertices");
    const std::vector<PlyProperty>& properties = parts.vertices->properties;
    for (const std::string name : {"x", "y", "z"}) {
        const PlyProperty* const p = named(properties, name);
        if (p == nullptr) fail(file, 0, "element vertex has no property '" + name + "'", "a mesh needs x, y and z");
        if (p->is_list) fail(file, p->line, "property '" + name + "' is a list", "it must be one number");
        parts.axis[static_cast<std::size_t>(name[0] - 'x')] = static_cast<std::size_t>(p - properties.data());
    }
    const PlyElement* const faces = named(header.elements, "face");
    const PlyElement* const strips = named(header.elements, "tristrips");
    parts.are_strips = strips != nullptr && (faces == nullptr || faces->count == 0);
    parts.faces = parts.are_strips ? strips : faces;
    parts.ignored = parts.are_strips ? nullptr : strips;
    if (parts.faces == nullptr) fail(file, 0, "no face element", "export the mesh as polygons");
    const auto is_corners = [](const PlyProperty& p) { return p.name == "vertex_indices" || p.name == "vertex_index"; };
    const auto corners = std::find_if(parts.faces->properties.rbegin(), parts.faces->properties.rend(), is_corners);
    if (corners == parts.faces->properties.rend())
        fail(file, parts.faces->line, "element " + parts.faces->name + " has no property 'vertex_indices'", "export the mesh as polygons");
    parts.corners = static_cast<std::size_t>(parts.faces->properties.rend() - corners) - 1;
    if (!corners->is_list || !is_integer(corners->type))
        fail(file, corners->line, "vertex index type must be a list of an integer type", "such as int");
    return parts;
}

}   // namespace meshfolio
