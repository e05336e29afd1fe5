#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/joined.h"
#include "base/lower_case.h"
#include "base/number_text.h"
#include "mesh/io/glb/glb_parts.h"
#include "mesh/io/mesh_encoders.h"
#include "mesh/io/mesh_files.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

using Strings = std::vector<std::string>;

/// Returns "N values of a, b …" for each kind of value that a float of glTF does not hold.
Strings values_that_change(const Attributes& attributes) {
    struct Kind {
        bool (*is_met)(double);
        const char* message;
        long long count = 0;
        Strings names = {};
    };
    using Float = std::numeric_limits<float>;
    std::array kinds{Kind{[](double x) { return !std::isfinite(x); },
                          "are undefined or infinite, which glTF forbids: 0 or the largest float stands for them"},
                     Kind{[](double x) { return std::isfinite(x) && std::abs(x) > Float::max(); },
                          "are beyond the largest float (3.4e38), which stands for them"},
                     Kind{[](double x) { return x != 0 && std::abs(x) < Float::min() && static_cast<float>(x) != x; },
                          "are too small for a float (below 1.2e-38): 0 or a coarser value stands for them"},
                     Kind{[](double x) { return std::abs(x) <= 1LL << 53 && std::floor(x) == x && static_cast<float>(x) != x; },
                          "are whole numbers beyond those of a float, and rounded"}};
    Strings sentences;
    for (const ColumnGroup group : groups_of(attributes.columns)) {
        if (is_gltf_color(group)) {
            const auto without = std::ranges::count_if(group.front().values, [](double x) { return std::isnan(x); });
            if (without > 0) sentences.push_back(std::to_string(without) + " vertices have no colour, and are written as white");
            continue;
        }
        if (group.size() > 1 && group.front().name == "red")
            sentences.push_back("colours that are no floats between 0 and 1 are written as values (_red, _green, _blue), not as colours");
        for (const VertexColumn& column : group) {
            for (Kind& kind : kinds) {
                const auto count = std::ranges::count_if(column.values, kind.is_met);
                if (count > 0 && !is_normal(column)) kind.names.push_back(column.name);
                kind.count += is_normal(column) ? 0 : count;
            }
        }
    }
    for (const Kind& kind : kinds)
        if (kind.count > 0)
            sentences.push_back(std::to_string(kind.count) + " values of " + first_of_many(kind.names) + " " + kind.message +
                                "; PLY and VTP keep them");
    return sentences;
}

/// Returns sentences on damage to the surface by rounding coordinates to floats, and by readers that weld vertices at one place.
Strings corners_that_move(const std::string& format, const TriangleMesh& mesh) {
    constexpr double turned = 0.996;         // the cosine of 5°
    constexpr double worth_telling = 1e-3;   // of an edge: curvatures change by some per cent
    const bool is_glb = format == "GLB";
    const TriangleMesh rounded{stored_as_floats(mesh, is_glb ? float_frame(mesh) : GlbFrame()), mesh.F};
    const std::vector<int> together = one_part(mesh), parts = is_glb ? parts_that_keep_apart(mesh, rounded.X) : together;
    const Positions before = face_normals(mesh), after = face_normals(rounded);   // 0 where there is no area
    const Vector cosines = before.cwiseProduct(after).rowwise().sum();
    const auto spoilt = (before.rowwise().squaredNorm().array() > 0 && cosines.array() < turned).count();
    const int met = count_of_welded(mesh.X, together), merged = count_of_welded(rounded.X, together) - met;
    const int welded = std::min(met, count_of_welded(mesh.X, parts));
    const std::string of_all = " of " + std::to_string(mesh.vertex_count()) + " vertices ";
    Strings sentences;
    if (welded > 0)
        sentences.push_back(std::to_string(welded) + of_all + "lie where others do and are one with them when the " + format +
                            " file is read again; OBJ, OFF, PLY and VTP keep them apart");
    const double moved = (rounded.X - mesh.X).rowwise().norm().maxCoeff(), share = moved / mean_edge_length(mesh);
    if (spoilt == 0 && merged == 0 && share > worth_telling)
        sentences.push_back("rounded to the floats of " + format + ", vertices move by up to " + plain_text(100 * share, 2) +
                            " % of the mean edge, and curvatures change; write OBJ, OFF, PLY or VTP, or move the mesh to the origin");
    if (spoilt > 0 || merged > 0)
        sentences.push_back("rounded to the floats of " + format + ", " + std::to_string(merged) + of_all + "fall onto others and " +
                            std::to_string(spoilt) + " of " + std::to_string(mesh.face_count()) +
                            " faces turn by 5 degrees or vanish; write OBJ, OFF, PLY or VTP, or move the mesh to the origin");
    return sentences;
}

}   // namespace

std::vector<std::string> losses(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes) {
    const std::string ending = file == "-" ? ".obj" : lower_case_ending(file);
    std::string format = ending.substr(std::min<std::size_t>(1, ending.size()));
    std::ranges::transform(format, format.begin(), [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    const Strings holding = column_endings();
    const bool is_same_text = ending == ".obj" && !attributes.obj.empty();
    Strings found, names;
    for (const VertexColumn& column : attributes.columns)
        if (!is_normal(column)) names.push_back(column.name);
    if (!is_same_text && !names.empty() && std::ranges::find(holding, ending) == holding.end())
        found.push_back(format + " holds no values of vertices: not kept are " + first_of_many(names) + "; write PLY or VTP for them");
    if (ending != ".obj" && (attributes.obj.find("\nvt ") != std::string::npos || attributes.obj.find("\nusemtl ") != std::string::npos))
        found.push_back("texture coordinates, groups and materials are kept from OBJ to OBJ only");
    for (const Strings& more : {ending == ".glb" ? values_that_change(attributes) : Strings(),
                                ending == ".glb" || ending == ".stl" ? corners_that_move(format, mesh) : Strings()})
        found.insert(found.end(), more.begin(), more.end());
    return found;
}

}   // namespace meshfolio
