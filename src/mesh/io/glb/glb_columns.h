/// @file
/// The values of vertices in glTF: COLOR_0 and application-specific attributes (§3.7.2.1).
#pragma once

#include <set>
#include <string>
#include <vector>

#include "mesh/io/glb/glb_document.h"

namespace meshfolio {

class GlbColumns {
public:
    GlbColumns(GlbDocument& document, WarningTally& warnings) : document_(document), warnings_(warnings) {}

    /// Adds the values of a primitive: element vertices[i] of each of its accessors belongs to point number before + i.
    void add(const GlbDocument::Json& primitive, const std::vector<std::uint32_t>& vertices, std::size_t before);
    /// Returns the columns of the welded mesh. Colours are sRGB: in 8 bits if these hold them, else in 16 bits or floats. Points without a
    /// colour are white (§3.7.2.1), values of points without one are NaN. Warns of attributes that are not kept.
    std::vector<VertexColumn> of_vertices(const WeldedMesh& mesh);

private:
    struct Column {
        std::string attribute, name, array;
        int component;
        ScalarType type;
        std::vector<double> values;   // of points; of a colour: linear light in [0, 1]
        bool has_gaps = false;        // some points have no value

        bool is_color() const { return attribute == "COLOR_0"; }
        void fill(std::size_t points);
    };
    Column& column(const std::string& attribute, const GlbAccessor& values, int component);
    void add_attribute(const std::string& name, const GlbAccessor& values, const std::vector<std::uint32_t>& vertices, std::size_t before);
    ScalarType color_type() const;

    GlbDocument& document_;
    WarningTally& warnings_;
    std::vector<Column> columns_;
    std::set<std::string> not_kept_;
};

}   // namespace meshfolio
