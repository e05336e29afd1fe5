/// @file
/// The values that vertices of glTF carry: COLOR_0 and attributes of an application's own (§3.7.2.1).
#pragma once

#include <set>
#include <string>
#include <vector>

#include "mesh/io/glb/glb_document.h"

namespace meshfolio {

class GlbColumns {
public:
    GlbColumns(GlbDocument& document, WarningTally& warnings) : document_(document), warnings_(warnings) {}

    /// Adds those of a primitive: `vertices` of its accessors are points `before` and so on.
    void add(const GlbDocument::Json& primitive, const std::vector<std::uint32_t>& vertices, std::size_t before);
    /// Columns of the welded mesh. Colours are sRGB: as 8 bits where that is what they are, else as 16 bits or floats. Points without a
    /// colour are white (§3.7.2.1), without another value NaN. Warns of what is not kept.
    std::vector<VertexColumn> of_vertices(const WeldedMesh& mesh);

private:
    struct Column {
        std::string attribute, name, array;
        int component;
        ScalarType type;
        std::vector<double> values;   // of points; of a colour: linear light in [0, 1]
        bool has_gaps = false;

        bool is_color() const { return attribute == "COLOR_0"; }
        void fill(std::size_t points);
    };
    Column& column(const std::string& attribute, const GlbAccessor& values, int component);
    void add_attribute(const std::string& name, const GlbAccessor& values, const std::vector<std::uint32_t>& vertices, std::size_t before);
    ScalarType color_type() const;
    void count_seams(const WeldedMesh& mesh);

    GlbDocument& document_;
    WarningTally& warnings_;
    std::vector<Column> columns_;
    std::set<std::string> not_kept_;
};

}   // namespace meshfolio
