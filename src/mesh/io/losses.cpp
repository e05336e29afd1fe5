#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/joined.h"
#include "base/lower_case.h"
#include "mesh/io/mesh_encoders.h"
#include "mesh/io/mesh_files.h"
#include "mesh/point_table.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

using Strings = std::vector<std::string>;

Strings values_without_place(const std::string& format, const Attributes& attributes) {
    Strings names;
    for (const VertexColumn& column : attributes.columns)
        if (!is_normal(column)) names.push_back(column.name);
    if (names.empty()) return {};
    return {format + " holds no values of vertices: not kept are " + joined(names, ", ") + "; write PLY or VTP for them"};
}

Strings values_that_change(const Attributes& attributes) {
    constexpr double exact = 1LL << 53;
    const auto is_changed = [](double x) {
        return std::abs(x) <= exact && std::floor(x) == x && static_cast<double>(static_cast<float>(x)) != x;
    };
    std::array<std::pair<long long, Strings>, 2> found;   // what is not finite, what is rounded
    for (const VertexColumn& column : attributes.columns) {
        const std::array counts{std::ranges::count_if(column.values, [](double x) { return !std::isfinite(x); }),
                                std::ranges::count_if(column.values, is_changed)};
        for (std::size_t kind = 0; kind < counts.size(); ++kind) {
            if (counts[kind] == 0) continue;
            found[kind].first += counts[kind];
            found[kind].second.push_back(column.name);
        }
    }
    constexpr std::array told{"are undefined or infinite, which glTF forbids: 0 or the largest float stands for them",
                              "are whole numbers beyond those of a float, and rounded"};
    Strings sentences;
    for (std::size_t kind = 0; kind < told.size(); ++kind) {
        const auto& [count, names] = found[kind];
        if (count > 0)
            sentences.push_back(std::to_string(count) + " values of " + joined(names, ", ") + " " + told[kind] + "; PLY and VTP keep them");
    }
    return sentences;
}

/// What becomes of the surface where coordinates are rounded to floats.
Strings corners_that_move(const std::string& format, const TriangleMesh& mesh) {
    constexpr double turned = 0.996;   // the cosine of 5°
    const TriangleMesh rounded{mesh.X.cast<float>().cast<double>(), mesh.F};
    const auto places = [](const TriangleMesh& of) {
        PointTable table(static_cast<std::size_t>(of.vertex_count()));
        for (int v = 0; v < of.vertex_count(); ++v) table.number_of({of.X(v, 0), of.X(v, 1), of.X(v, 2)});
        return table.points().size();
    };
    const Positions before = face_normals(mesh), after = face_normals(rounded);   // 0 where there is no area
    const Vector cosines = before.cwiseProduct(after).rowwise().sum();
    const auto spoilt = (before.rowwise().squaredNorm().array() > 0 && cosines.array() < turned).count();
    const std::size_t merged = places(mesh) - places(rounded);
    if (spoilt == 0 && merged == 0) return {};
    return {"rounded to the floats of " + format + ", " + std::to_string(merged) + " of " + std::to_string(mesh.vertex_count()) +
            " vertices fall onto others and " + std::to_string(spoilt) + " of " + std::to_string(mesh.face_count()) +
            " faces turn by 5 degrees or vanish; write OBJ, OFF, PLY or VTP, or move the mesh to the origin"};
}

}   // namespace

std::vector<std::string> losses(const TriangleMesh& mesh, const std::string& file, const Attributes& attributes) {
    const std::string ending = file == "-" ? ".obj" : lower_case_ending(file);
    std::string format = ending.substr(std::min<std::size_t>(1, ending.size()));
    std::ranges::transform(format, format.begin(), [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    const Strings holding = column_endings();
    const bool is_same_text = ending == ".obj" && !attributes.obj.empty();
    Strings found =
        is_same_text || std::ranges::find(holding, ending) != holding.end() ? Strings() : values_without_place(format, attributes);
    if (ending != ".obj" && (attributes.obj.find("\nvt ") != std::string::npos || attributes.obj.find("\nusemtl ") != std::string::npos))
        found.push_back("texture coordinates, groups and materials are kept from OBJ to OBJ only");
    for (const Strings& more : {ending == ".glb" ? values_that_change(attributes) : Strings(),
                                ending == ".glb" || ending == ".stl" ? corners_that_move(format, mesh) : Strings()})
        found.insert(found.end(), more.begin(), more.end());
    return found;
}

}   // namespace meshfolio
