#include "run/mark/marking.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/errors.h"
#include "base/lower_case.h"
#include "mesh/io/csv_column.h"
#include "mesh/io/mesh_files.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

/// Returns the first file with a path or bare name that matches the pattern, or else matches it in any case; null: none.
const std::pair<const std::string, std::string>* file_like(const submission::HandedIn& files, const std::string& pattern) {
    const auto fits = [](const std::string& as_asked_for, const std::string& path) {
        const std::string name = path.substr(path.rfind('/') + 1);
        return fnmatch(as_asked_for.c_str(), path.c_str(), 0) == 0 || fnmatch(as_asked_for.c_str(), name.c_str(), 0) == 0;
    };
    for (const auto& file : files)
        if (fits(pattern, file.first)) return &file;
    for (const auto& file : files)
        if (fits(lower_case(pattern), lower_case(file.first))) return &file;
    return nullptr;
}

/// A student's values, as many as right ones.
struct Given : GivenValues {
    bool faces_reversed = false;
};

/// Sorts the rows by a column of vertex numbers, which count from 0 or 1. Leaves them if there is no such column.
void sort_by_vertex(NumberColumn& column, const std::string& bytes, const std::string& file) try {
    const Eigen::Index count = column.values.size();
    const Vector vertex = csv_column(bytes, file, {"vertex", "vertex_id", "index", "id"}, count).values;
    const double first = vertex.minCoeff();
    std::vector<Eigen::Index> row_of(static_cast<std::size_t>(count), -1);
    for (Eigen::Index i = 0; i < count; ++i) {
        const double place = vertex[i] - first;
        if (!(place >= 0 && place < static_cast<double>(count)) || std::trunc(place) != place) return;
        row_of[static_cast<std::size_t>(place)] = i;
    }
    if (std::ranges::find(row_of, -1) != row_of.end()) return;   // a vertex is there twice
    column = {column.values(row_of).eval(), column.rounding(row_of).eval()};
} catch (const InputError&) {   // no such column
}

/// Returns the number of triangles of A that equal the triangle of B with their number turned round, from any corner.
int reversed_triangles(const Faces& A, const Faces& B) {
    int reversed = 0;
    for (Eigen::Index t = 0; t < A.rows(); ++t)
        for (int shift = 0; shift < 3; ++shift)
            reversed += A(t, 0) == B(t, shift) && A(t, 1) == B(t, (shift + 2) % 3) && A(t, 2) == B(t, (shift + 1) % 3) ? 1 : 0;
    return reversed;
}

Given given_positions(const std::string& bytes, const std::string& file, const Reference& reference) {
    const LoadedMesh loaded = parse_mesh(bytes, file);
    const PreparedMesh& right = *reference.mesh->prepared;
    if (loaded.mesh.vertex_count() != right.mesh.vertex_count())
        throw InputError({file, 0}, "has " + std::to_string(loaded.mesh.vertex_count()) + " vertices, the mesh asked for has " +
                                        std::to_string(right.mesh.vertex_count()));
    Given given{{Eigen::Map<const Vector>(loaded.mesh.X.data(), loaded.mesh.X.size())}};
    // If the file of the mesh itself was turned, its own order is no mistake.
    const bool is_as_read = right.preflight.flipped_faces == 0 && right.preflight.inside_out_components == 0;
    if (is_as_read && loaded.mesh.face_count() == right.mesh.face_count())
        given.faces_reversed = 2 * reversed_triangles(loaded.mesh.F, right.mesh.F) > right.mesh.face_count();
    return given;
}

/// Reads the student's values for an item; nothing if there are none.
std::optional<Given> given_for(ItemMark& mark, const submission::HandedIn& files, const StudentAnswer& answer) {
    const RubricItem& item = *mark.item;
    if (item.what == MarkedThing::number) {
        mark.file = answers_file;
        return answer.value ? std::optional(Given{{Vector::Constant(1, *answer.value)}}) : std::nullopt;
    }
    const auto* found = file_like(files, item.file);
    if (found == nullptr) return {};
    const auto& [file, bytes] = *found;
    mark.file = file;
    // A file far larger than any answer for this mesh would only take time.
    constexpr std::size_t always = std::size_t{1} << 16, a_vertex = std::size_t{1} << 11;   // bytes
    const std::size_t most = always + a_vertex * static_cast<std::size_t>(mark.reference->mesh->mesh().vertex_count());
    if (bytes.size() > most)
        throw InputError({file}, "has " + std::to_string(bytes.size()) + " bytes, an answer on this mesh may have " + std::to_string(most));
    if (is_of_mesh(item.what)) return given_positions(bytes, file, *mark.reference);
    const MoreRows more = item.what == MarkedThing::eigenvalues ? MoreRows::left_out : MoreRows::refused;
    NumberColumn column = csv_column(bytes, file, item.columns, mark.reference->right.values.size(), more);
    if (item.what != MarkedThing::eigenvalues) sort_by_vertex(column, bytes, file);
    return Given{{std::move(column.values), std::move(column.rounding)}};
}

/// Returns the difference per vertex: signed for values, a distance for positions; empty for lists.
Vector difference_of(const Vector& given, const RubricItem& item, const Reference& reference) {
    if (item.what == MarkedThing::eigenvalues || item.what == MarkedThing::number) return {};
    const Vector difference = given - reference.right.values;
    if (!is_of_mesh(item.what)) return difference;
    const Eigen::Map<const Positions> rows(difference.data(), difference.size() / 3, 3);
    return rows.rowwise().norm();
}

void judge(ItemMark& mark, const Given& given, References& references) {
    const RubricItem& item = *mark.item;
    const RightValues& right = mark.reference->right;
    mark.agreement = agreement_of(given, right, item.tolerance);
    if (mark.agreement.where >= 0) {
        mark.given = given.values[mark.agreement.where];
        mark.expected = right.values[mark.agreement.where];
    }
    bool agrees = mark.agreement.agrees(item.tolerance);
    if (const auto& equal = mark.reference->equal; equal && !agrees) {
        const Positions positions = Eigen::Map<const Positions>(given.values.data(), given.values.size() / 3, 3);
        agrees = is_another_choice(positions, *equal, item.tolerance * right.scale);
        if (agrees) mark.agreement.worst = 0;
    }
    if (!agrees) {
        mark.difference = difference_of(given.values, item, *mark.reference);
        mark.conventions = recognised(given, right, item.what, item.tolerance,
                                      [&]() -> const std::vector<Variant>& { return references.variants_of(item, mark.settings); });
    }
    if (given.faces_reversed && agrees) mark.conventions.push_back({});
    if (given.faces_reversed)
        for (ConventionKeys& keys : mark.conventions) keys.emplace_back("reversed_faces");
    const auto is_accepted = [&](const ConventionKeys& keys) {
        return std::ranges::all_of(keys, [&](const std::string& key) { return contains(item.accept, key); });
    };
    mark.verdict = mark.conventions.empty()                             ? agrees ? Verdict::right : Verdict::wrong
                   : std::ranges::any_of(mark.conventions, is_accepted) ? Verdict::accepted
                                                                        : Verdict::recognised;
    const bool has_all = mark.verdict == Verdict::right || mark.verdict == Verdict::accepted;
    mark.score = has_all ? item.points : mark.verdict == Verdict::recognised ? item.recognised * item.points : 0;
}

/// Returns the right answer at the student's settings, or at those of the rubric if the student's have no answer.
const Reference& reference_for(ItemMark& mark, References& references, std::vector<std::string>& remarks) {
    try {
        return references.of(*mark.item, mark.settings);
    } catch (const Error& error) {
        if (mark.settings == mark.item->settings) throw;
        remarks.push_back(mark.item->id + ": " + error.what());
        mark.settings = mark.item->settings;
        return references.of(*mark.item, mark.settings);
    }
}

}   // namespace

double StudentMarks::score() const {
    double sum = 0;
    for (const ItemMark& mark : items) sum += mark.score;
    return sum;
}

StudentMarks marks_of(const submission::HandedIn& files, const Rubric& rubric, References& references) {
    StudentMarks marks;
    const auto* named = file_like(files, answers_file);
    const auto answers = parse_answers(named == nullptr ? "" : named->second, rubric, marks.remarks);
    for (const RubricItem& item : rubric.items) {
        ItemMark mark;
        mark.item = &item;
        mark.settings = answers.at(item.id).settings;
        mark.reference = &reference_for(mark, references, marks.remarks);
        try {
            if (const auto given = given_for(mark, files, answers.at(item.id))) judge(mark, *given, references);
        } catch (const Error& error) {
            mark.verdict = Verdict::unusable;
            mark.problem = error.what();
        }
        marks.items.push_back(std::move(mark));
    }
    return marks;
}

}   // namespace meshfolio::run
