#include <memory>
#include <numbers>

#include "base/joined.h"
#include "base/number_text.h"
#include "cli/commands.h"
#include "geometry/operators/laplace_operator.h"
#include "mesh/io/mesh_files.h"
#include "mesh/orientation.h"
#include "questions/bench/defects.h"
#include "report/writers.h"
#include "run/console.h"
#include "run/one_mesh/conditions.h"
#include "run/one_mesh/fields.h"
#include "run/one_mesh/inspection.h"
#include "run/progress.h"

namespace meshfolio::cli {

namespace {

std::string line(const std::string& name, const std::string& value) { return name + std::string(26 - name.size(), ' ') + value + "\n"; }

std::string in_words(const StabilityCertificate& proved, OperatorKind kind) {
    const std::string as_stored = has_intrinsic_lengths(kind) ? "of the operator as stored: " : "";
    const Definiteness& d = proved.bottom;
    const double limit = largest_stable_step(proved.top);
    const std::string interval =
        "smallest eigenvalue between " + plain_text(rounded_down(d.mu_low, 4), 4) + " and " + plain_text(rounded_up(d.mu_high, 4), 4);
    const std::string edge = "unstable from " + plain_text(rounded_up(2 / proved.mu_low, 10), 10);
    if (d.indefinite()) {
        return line("largest stable lambda",
                    "none: the operator is indefinite, " + interval + ", at vertex " + std::to_string(d.bottom.vertex)) +
               line("proved", as_stored + "a step multiplies that mode by 1 + " + plain_text(rounded_down(-d.mu_high, 4), 4) +
                                  " lambda or more: by " + plain_text(rounded_down(d.growth(limit), 6), 6) + " at " + plain_text(limit, 4) +
                                  " (2/mu_max)");
    }
    if (!d.semidefinite()) {
        return line("largest stable lambda", "at most " + plain_text(limit, 8) + ", set at vertex " + std::to_string(proved.top.vertex)) +
               line("proved", as_stored + edge + "; no step is proved stable: " + interval + ", which cannot be told from 0 here");
    }
    return line("largest stable lambda", plain_text(limit, 8) + " (always safe: " + plain_text(rounded_down(proved.lambda_safe(), 4), 4) +
                                             "), set at vertex " + std::to_string(proved.top.vertex)) +
           line("proved", as_stored + "stable up to " + plain_text(rounded_down(proved.lambda_low(), 10), 10) + ", " + edge);
}

std::string in_words(const Inspection& inspection) {
    const Preflight& p = inspection.prepared.preflight;
    const auto count = [&](const std::string& name, int n) { return line(name, std::to_string(n)); };
    // Scripts read the first line.
    std::string text = "V=" + std::to_string(p.vertices_in_use) + " F=" + std::to_string(p.triangles) +
                       " chi=" + std::to_string(p.euler_characteristic) + " comps=" + std::to_string(p.components) +
                       " bedges=" + std::to_string(p.boundary_edges) + " area=" + plain_text(p.area, 10) + "\n";
    text += count("unreferenced vertices", p.vertices - p.vertices_in_use);
    text += count("edges", p.edges) + count("boundary loops", p.boundary_loops);
    text += line("genus", p.genus >= 0 ? std::to_string(p.genus) : "not defined");
    text += line("orientable", p.orientable ? "yes" : "no");
    text += count("non-manifold edges", p.nonmanifold_edges) + count("non-manifold vertices", p.nonmanifold_vertices);
    text += count("zero-area faces", p.zero_area_faces) + count("needle faces", p.needle_faces) +
            count("duplicated positions", p.duplicated_positions);
    text += count("dropped faces", p.dropped_degenerate_faces + p.dropped_duplicate_faces);
    text += count("flipped faces", p.flipped_faces) + count("inside-out components", p.inside_out_components);
    text += line("volume", p.encloses_volume() ? plain_text(p.volume)
                                               : "undefined: " + why_no_volume(inspection.prepared.mesh, inspection.prepared.topology));
    text += line("mean edge", plain_text(p.mean_edge));
    text += line("edge lengths", plain_text(inspection.facts.shortest_edge) + " to " + plain_text(inspection.facts.longest_edge));
    text += line("smallest angle", plain_text(inspection.facts.smallest_angle * 180 / std::numbers::pi, 4) + " degrees");
    const Vector3 extent = p.box_high - p.box_low;
    text += line("box", plain_text(extent.x()) + " x " + plain_text(extent.y()) + " x " + plain_text(extent.z()) + ", " +
                            plain_text(inspection.facts.offset, 3) + " diagonals from the origin (centred and scaled inside)");
    text +=
        line("Gauss-Bonnet", "sum of deficits / 2 pi = " + plain_text(inspection.deficits_over_2pi(), 12) +
                                 (p.manifold() ? ", off by " + plain_text(inspection.facts.gauss_bonnet_residual, 2) : ", not manifold"));
    if (inspection.stability) text += in_words(*inspection.stability, inspection.kind);
    if (inspection.joined_vertices > 0)
        text += line("joined vertices", std::to_string(inspection.joined_vertices) +
                                            " at the ends of edges of length 0: each counts as one with the other end");
    if (inspection.floored) {
        text += line("with zero-area faces", plain_text(*inspection.floored, 8) +
                                                 " if their cotangents counted, cut off at 1e12; flip edges, or take --operator tufted");
    }
    const auto defects = defects_of(inspection.facts);
    text += defects.empty() ? "nothing found that affects a question\n" : "found\n";
    for (const auto& [defect, number] : defects) {
        text += "  " + std::to_string(number) + " x " + defect->name() + "\n    affects " + affected_for_people(*defect) + ": " +
                defect->breaks() + "\n    done: " + defect->done() + "\n";
    }
    return text;
}

struct InspectFlags {
    std::string mesh, measure, laplacian = "cotan", junit;
    std::vector<std::string> conditions;
    bool json = false;
};

/// Complains about the conditions that fail, in one line.
ExitCode result_of(const std::vector<Condition>& conditions, const std::string& mesh) {
    std::vector<std::string> failed;
    for (const Condition& condition : conditions) {
        const std::string measured = text_of(condition.measured);
        if (!condition.holds) failed.push_back(condition.text + " (" + (measured.empty() ? "undefined" : measured) + ")");
    }
    if (failed.empty()) return ExitCode::ok;
    complain(shown(mesh) + ": " + std::to_string(failed.size()) + " of " + std::to_string(conditions.size()) +
                 " conditions failed: " + first_of_many(failed),
             Ink::red);
    return ExitCode::failed;
}

ExitCode run_inspect(const InspectFlags& options) {
    std::vector<Condition> conditions = conditions_in(meshfolio::joined(options.conditions, ","));
    if (!options.measure.empty() && (options.json || !conditions.empty()))
        throw UsageError("one measure goes with neither --json nor --require", "take one of them");
    if (!options.junit.empty() && conditions.empty()) throw UsageError("--junit needs --require", "name conditions, or leave it out");
    check_output("--junit", options.junit, {".xml"});
    const std::string key = options.measure.empty() ? "" : measure_key(options.measure);
    const OperatorKind kind = operator_named(options.laplacian);
    const Inspection inspection = about_mesh(options.mesh, [&] {
        std::optional<Stage> stage;
        return inspect_mesh(load_mesh(options.mesh), kind, [&](std::string_view what) { stage.emplace(std::string(what)); });
    });
    if (!inspection.no_stability.empty()) warn(options.mesh + ": largest stable step not computed: " + inspection.no_stability);
    try_on(inspection, conditions);
    if (!options.junit.empty()) output::replace_file(options.junit, write_junit(document_of(conditions, shown(options.mesh)), false));
    if (!key.empty()) {
        const std::string value = text_of(measures_of(inspection)[key]);
        if (value.empty()) warn(shown(options.mesh) + ": " + key + " is undefined");
        print(value + "\n");
    } else if (options.json) {
        print(inspection_json(inspection, conditions) + "\n");
    } else {
        print(for_terminal(conditions.empty() ? in_words(inspection) : lines_of(conditions)));
    }
    return result_of(conditions, options.mesh);
}

}   // namespace

Command inspect_command(CLI::App& parent) {
    const auto options = std::make_shared<InspectFlags>();
    CommandOptions app(parent, "inspect", "Counts, defects, Gauss-Bonnet, largest stable step; conditions");
    app.required("MESH", options->mesh, formats_read);
    app.text("MEASURE", options->measure, "print this value of --json alone, such as genus or gauss_bonnet.residual");
    app.choice("--operator", options->laplacian, operator_choices(), "operator for the largest stable step");
    app.flag("--json", options->json, "for programs");
    app.texts("--require CONDITIONS", options->conditions,
              "print whether conditions hold, with commas between them; a measure of --json that must be true, or that is compared by one "
              "of = != < <= > >= with a number");
    app.text("--junit FILE", options->junit, "the conditions as JUnit XML, for CI");
    app.footer(
        "Exit code 1 if a condition fails, as every one on an undefined measure. watertight is closed, manifold and orientable.\n"
        "Example: meshfolio inspect bunny.off --require 'closed,manifold,components=1,genus=0,volume>0'");
    return {app, [options] { return run_inspect(*options); }};
}

}   // namespace meshfolio::cli
