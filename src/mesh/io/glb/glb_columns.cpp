#include "mesh/io/glb/glb_columns.h"

#include "base/at.h"
#include "base/joined.h"

namespace meshfolio {

void GlbColumns::Column::fill(std::size_t points) {
    has_gaps |= values.size() < points;
    values.resize(points, is_color() ? 1 : std::numeric_limits<double>::quiet_NaN());
}

void GlbColumns::add(const GlbDocument::Json& primitive, const std::vector<std::uint32_t>& vertices, std::size_t before) {
    const GlbDocument::Json& attributes = primitive.at("attributes");
    document_.spend(8 * attributes.size());
    for (const auto& [name, index] : attributes.items()) {
        if (name == "COLOR_0" || name.starts_with('_')) add_attribute(name, document_.accessor(attributes, name), vertices, before);
        else if (name != "POSITION" && name != "NORMAL" && !name.starts_with("JOINTS_") && !name.starts_with("WEIGHTS_"))
            not_kept_.insert(name);
    }
    if (primitive.contains("material")) not_kept_.insert("material");
}

/// Returns the column of a component, which is added if it is new.
GlbColumns::Column& GlbColumns::column(const std::string& attribute, const GlbAccessor& values, int component) {
    static constexpr std::array channels{"red", "green", "blue", "alpha"};
    const auto found =
        std::ranges::find_if(columns_, [&](const Column& c) { return c.attribute == attribute && c.component == component; });
    if (found != columns_.end()) return *found;
    const bool is_color = attribute == "COLOR_0", is_alone = values.components == 1;
    const std::string own = attribute.substr(1);
    const std::string name = is_color   ? channels[at(component)]
                             : is_alone ? own
                                        : component_name(own, at(component), at(values.components));
    return columns_.emplace_back(Column{attribute, name, is_color || is_alone ? "" : own, component, values.type, {}});
}

void GlbColumns::add_attribute(const std::string& name, const GlbAccessor& values, const std::vector<std::uint32_t>& vertices,
                               std::size_t before) {
    const bool is_color = name == "COLOR_0";
    if (vertices.empty() || vertices.back() >= values.count) document_.damaged(name + " has another count than the positions");
    if (is_color && values.components != 3 && values.components != 4) document_.damaged("colours are neither VEC3 nor VEC4");
    document_.refuse_too_many((columns_.size() + at(values.components)) * (before + vertices.size()) / 4);
    GlbAccessor stored = values;
    stored.normalized = is_color && is_integer(values.type);
    for (int k = 0; k < values.components; ++k) {
        Column& into = column(name, values, k);
        if (into.type != values.type) into.type = is_color ? std::max(into.type, values.type) : ScalarType::float64;
        into.fill(before);
        for (const std::uint32_t v : vertices) {
            const double value = stored(v, k);
            const bool is_inside = !is_color || (value >= 0 && value <= 1);
            if (!is_inside) warnings_.add(0, "channel of a colour beyond 0 to 1 clamped", "channels of colours beyond 0 to 1 clamped");
            into.values.push_back(is_inside ? value : value > 1 ? 1 : 0);
        }
    }
}

/// Returns the type that colours get: 8 bits if these hold every channel up to the rounding of 16 bits, else the widest type of a colour in
/// the file.
ScalarType GlbColumns::color_type() const {
    constexpr double rounded = 1.5 / 65535;
    ScalarType type = ScalarType::uint8;
    bool is_byte = true;
    for (const Column& column : columns_) {
        if (!column.is_color()) continue;
        type = std::max(type, column.type);
        is_byte = is_byte && std::ranges::all_of(column.values, [&](double x) {
                      const double near =
                          column.component == 3 ? std::round(255 * x) / 255 : linear_of_srgb(std::round(255 * srgb_of_linear(x)) / 255);
                      return std::abs(x - near) <= rounded;
                  });
    }
    return is_byte || type <= ScalarType::uint8 ? ScalarType::uint8 : type <= ScalarType::uint16 ? ScalarType::uint16 : ScalarType::float32;
}

std::vector<VertexColumn> GlbColumns::of_vertices(const WeldedMesh& mesh) {
    std::vector<char> differs(mesh.first.size(), 0);
    for (Column& column : columns_) {
        column.fill(mesh.vertex.size());
        for (std::size_t point = 0; point < column.values.size(); ++point) {
            const double here = column.values[point], kept = column.values[at(mesh.first[at(mesh.vertex[point])])];
            if (here != kept && !(std::isnan(here) && std::isnan(kept))) differs[at(mesh.vertex[point])] = 1;
        }
    }
    for (auto count = std::ranges::count(differs, 1); count > 0; --count)
        warnings_.add(0, "vertex has other colours or values across a seam: the first are kept",
                      "vertices have other colours or values across a seam: the first are kept");
    const ScalarType color = color_type();
    const double largest = color == ScalarType::uint8 ? 255 : color == ScalarType::uint16 ? 65535 : 1;
    std::vector<VertexColumn> kept;
    for (const Column& column : columns_) {
        Vector values(static_cast<Eigen::Index>(mesh.first.size()));
        for (Eigen::Index v = 0; v < values.size(); ++v) {
            values[v] = column.values[at(mesh.first[static_cast<std::size_t>(v)])];
            if (!column.is_color()) continue;
            const double channel = largest * (column.component == 3 ? values[v] : std::min(srgb_of_linear(values[v]), 1.0));
            values[v] = is_integer(color) ? std::round(channel) : channel;
        }
        const bool holds_nan = column.has_gaps && is_integer(column.type);
        const ScalarType type = column.is_color() ? color : holds_nan ? ScalarType::float64 : column.type;
        kept.push_back({column.name, std::move(values), type, column.array});
    }
    if (!not_kept_.empty())
        warnings_.add(0, "attributes that are not kept", "attributes that are not kept",
                      first_of_many({not_kept_.begin(), not_kept_.end()}));
    return kept;
}

}   // namespace meshfolio
