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

/// The first file whose path or bare name matches; if none does, the first that matches ignoring case.
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

/// Values to compare with the right ones: as many.
struct Given : GivenValues {
    bool faces_reversed = false;
};

/// Refuses files far larger than any answer for this mesh, which would only take time.
void require_fitting_size(const std::string& bytes, const std::string& file, Eigen::Index vertices) {
    constexpr std::size_t always = std::size_t{1} << 16, a_vertex = std::size_t{1} << 11;   // bytes
    const std::size_t most = always + a_vertex * static_cast<std::size_t>(vertices);
    if (bytes.size() > most)
        throw InputError({file}, "has " + std::to_string(bytes.size()) + " bytes, an answer on this mesh may have " + std::to_string(most));
}

/// Rows may come in any order where a column says of which vertex each is, from 0 or 1 on.
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
    if (std::ranges::find(row_of, -1) != row_of.end()) return;   // one stands twice
    column = {column.values(row_of).eval(), column.rounding(row_of).eval()};
} catch (const InputError&) {   // no such column
}

Given given_column(const std::string& bytes, const std::string& file, const RubricItem& item, const Reference& reference) {
    const MoreRows more = item.what == MarkedThing::eigenvalues ? MoreRows::left_out : MoreRows::refused;
    NumberColumn column = csv_column(bytes, file, item.columns, reference.right.values.size(), more);
    if (item.what != MarkedThing::eigenvalues) sort_by_vertex(column, bytes, file);
    return {{std::move(column.values), std::move(column.rounding)}};
}

/// How many triangles of A are those of B, corner by corner from any of them on. @param turned  B's turned round
int same_triangles(const Faces& A, const Faces& B, bool turned) {
    int same = 0;
    for (Eigen::Index t = 0; t < A.rows(); ++t) {
        for (int shift = 0; shift < 3; ++shift) {
            bool all = true;
            for (int c = 0; c < 3; ++c) all = all && A(t, c) == B(t, (shift + (turned ? 3 - c : c)) % 3);
            same += all ? 1 : 0;
        }
    }
    return same;
}

Given given_positions(const std::string& bytes, const std::string& file, const Reference& reference) {
    const LoadedMesh loaded = parse_mesh(bytes, file);
    const PreparedMesh& right = *reference.mesh->prepared;
    if (loaded.mesh.vertex_count() != right.mesh.vertex_count())
        throw InputError({file, 0}, "has " + std::to_string(loaded.mesh.vertex_count()) + " vertices, the mesh asked for has " +
                                        std::to_string(right.mesh.vertex_count()));
    Given given{{Eigen::Map<const Vector>(loaded.mesh.X.data(), loaded.mesh.X.size())}};
    // Where the file itself was turned, its own order is no mistake.
    const bool is_as_read = right.preflight.flipped_faces == 0 && right.preflight.inside_out_components == 0;
    if (is_as_read && loaded.mesh.face_count() == right.mesh.face_count())
        given.faces_reversed = 2 * same_triangles(loaded.mesh.F, right.mesh.F, true) > right.mesh.face_count();
    return given;
}

/// Per vertex: signed for values, distances for positions; empty for lists.
Vector difference_of(const Vector& given, const RubricItem& item, const Reference& reference) {
    if (item.what == MarkedThing::eigenvalues || item.what == MarkedThing::number) return {};
    const Vector difference = given - reference.right.values;
    if (!is_of_mesh(item.what)) return difference;
    const Eigen::Map<const Positions> rows(difference.data(), difference.size() / 3, 3);
    return rows.rowwise().norm();
}

bool is_accepted(const std::vector<ConventionKeys>& conventions, const RubricItem& item) {
    return std::ranges::any_of(conventions, [&](const ConventionKeys& keys) {
        return std::ranges::all_of(keys, [&](const std::string& key) { return contains(item.accept, key); });
    });
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
    mark.verdict = mark.conventions.empty()              ? agrees ? Verdict::right : Verdict::wrong
                   : is_accepted(mark.conventions, item) ? Verdict::accepted
                                                         : Verdict::recognised;
    const bool is_full = mark.verdict == Verdict::right || mark.verdict == Verdict::accepted;
    mark.score = is_full ? item.points : mark.verdict == Verdict::recognised ? item.recognised * item.points : 0;
}

/// What the student gives for this item; nothing where it is not there.
std::optional<Given> given_for(ItemMark& mark, const submission::HandedIn& files, const StudentAnswer& answer) {
    const RubricItem& item = *mark.item;
    if (item.what == MarkedThing::number) {
        mark.file = answers_file;
        return answer.value ? std::optional(Given{{Vector::Constant(1, *answer.value)}}) : std::nullopt;
    }
    const auto* file = file_like(files, item.file);
    if (file == nullptr) return {};
    mark.file = file->first;
    require_fitting_size(file->second, file->first, mark.reference->mesh->mesh().vertex_count());
    if (is_of_mesh(item.what)) return given_positions(file->second, file->first, *mark.reference);
    return given_column(file->second, file->first, item, *mark.reference);
}

/// The right answer at the student's settings, at those of the rubric where they have none.
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
