// The ledger of claims: verdicts follow from the rules, planted claims get the right verdicts, and every claim of the list is complete.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_laws.h"
#include "mesh/io/mesh_files.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/claims/parts.h"
#include "questions/core/study_laws.h"
#include "shared_meshes.h"
#include "temporary_folder.h"

namespace meshfolio::claims {
using namespace testing_tools;
using enum Rule::Relation;

namespace {

Measurement measured(std::vector<double> values) {
    Measurement m;
    for (const double value : values) m.cases.push_back({"case " + std::to_string(m.cases.size() + 1), value});
    return m;
}

Verdict verdict_of(const Rule& rule, std::vector<double> values) { return decide(rule, measured(std::move(values))).verdict; }

// ---- planted claims, measured like those of the ledger --------------------------------------------------------------------

/// Roughness after 400 explicit steps of this share of the limit, over that at the start.
Measurement energy_after(ClaimBench& bench, double share) {
    const SmoothingSubject& s = bench.subject("sphere");
    const Positions& X = bench.run("sphere", {SmoothingScheme::explicit_euler, share * s.critical, 400}).X;
    Measurement m;
    m.cases = {{"sphere", roughness(s, X) / roughness(s, s.mesh().X)}};
    return m;
}
Measurement below_the_limit(ClaimBench& bench, const MeshNames&) { return energy_after(bench, 0.5); }
Measurement beyond_the_limit(ClaimBench& bench, const MeshNames&) { return energy_after(bench, 1.5); }
Measurement total_curvature(ClaimBench& bench, const MeshNames&) {
    const LibraryMesh& torus = *bench.mesh("torus").mesh;
    Measurement m;
    m.cases = {{"torus", angle_deficit(torus.mesh(), torus.prepared->topology).sum() / (2 * M_PI)}};
    return m;
}
Measurement sphere_curvature_measured(ClaimBench& bench, const MeshNames&) {
    const LibraryMesh& sphere = *bench.mesh("sphere").mesh;
    const Vector H = cotangent_mean_curvature(sphere.mesh(), sphere.prepared->topology, bench.subject("sphere").laplacian);
    Measurement m;
    m.cases = {{"sphere", H.mean()}};
    return m;
}

Claim planted(const Rule& rule, Measure measure, const About& about = {}) { return {"claims_planted", "q5", about, rule, measure}; }

Verdict judged_verdict(const Rule& rule, Measure measure) {
    const MeshLibrary library({}, {});
    const QuestionSettings settings = quick_settings();
    ClaimBench bench(library, settings);
    return judged(planted(rule, measure), bench).decision.verdict;
}

}   // namespace

TEST(ClaimRule, TheVerdictDependsOnHowManyCasesSatisfyIt) {
    const Rule rule{"x", "", at_most, 5};
    EXPECT_EQ(verdict_of(rule, {1, 5}), Verdict::holds);
    EXPECT_EQ(verdict_of(rule, {1, 5.0001}), Verdict::conditional);
    EXPECT_EQ(verdict_of(rule, {6, 7}), Verdict::refuted);
    const Rule other{"x", "", at_least, 5};
    EXPECT_EQ(verdict_of(other, {5, 6}), Verdict::holds);
    EXPECT_EQ(verdict_of(other, {4, 6}), Verdict::conditional);
    EXPECT_EQ(verdict_of(other, {4}), Verdict::refuted);
}

TEST(ClaimRule, UndefinedCasesDecideNothing) {
    const Rule rule{"x", "", at_most, 5};
    EXPECT_EQ(verdict_of(rule, {std::nan(""), 1}), Verdict::holds);
    EXPECT_EQ(verdict_of(rule, {std::nan("")}), Verdict::undecidable);
    EXPECT_EQ(verdict_of(rule, {}), Verdict::undecidable);
    EXPECT_EQ(verdict_of(rule, {INFINITY, 7}), Verdict::refuted);
    Measurement absent = measured({1});
    absent.undecidable = "the mesh is not there";
    EXPECT_EQ(decide(rule, absent).verdict, Verdict::undecidable);
    EXPECT_EQ(decide(rule, absent).why, "the mesh is not there");
}

TEST(ClaimRule, TheDecidingCaseIsTheOneNearestToTheThreshold) {
    const Rule rule{"x", "", at_most, 5};
    EXPECT_EQ(decide(rule, measured({1, 4, 2})).deciding, 1u);
    EXPECT_EQ(decide(rule, measured({100, 6, 50})).deciding, 1u);
    EXPECT_EQ(decide(rule, measured({1, 4.9, 50, 6})).deciding, 3u) << "of those that do not satisfy the rule";
    EXPECT_EQ(decide({"x", "", at_least, 0}, measured({-3, -1, -2})).deciding, 1u);
}

TEST(ClaimRule, TheRuleTextIsASentence) {
    JudgedClaim judged;
    Claim claim;
    judged.claim = &claim;
    claim.rule = {"best_steps", "mean edges", at_least, 1};
    EXPECT_EQ(report::plain(rule_text(judged)), "Required: best step for much noise over that for little ≥ 1\u202fmean edge.");
    EXPECT_EQ(with_unit(2, claim.rule), "2\u202fmean edges");
    claim.rule = {"energy", "%", at_most, 2};
    EXPECT_EQ(report::plain(rule_text(judged)), "Required: Dirichlet energy left, over that of the input, ≤ 2\u202f%.");
}

TEST(ClaimRule, AChangedResultChangesTheVerdict) {
    const MeshLibrary library({}, {});
    const QuestionSettings settings = quick_settings();
    ClaimBench bench(library, settings);
    int changed = 0;
    for (const Claim& claim : claim_list()) {
        const JudgedClaim before = judged(claim, bench);
        if (before.decision.verdict == Verdict::undecidable) continue;
        Measurement other = before.measurement;
        // Reflects each value about the threshold, so that it lies on the other side and never on it.
        for (Case& c : other.cases) c.value = 2 * claim.rule.threshold - c.value + (claim.rule.relation == at_most ? 1e-12 : -1e-12);
        const Verdict after = decide(claim.rule, other).verdict;
        const Verdict opposite = before.decision.verdict == Verdict::holds     ? Verdict::refuted
                                 : before.decision.verdict == Verdict::refuted ? Verdict::holds
                                                                               : Verdict::conditional;
        EXPECT_EQ(after, opposite) << claim.id;
        JudgedClaim rejudged{&claim, other, decide(claim.rule, other)};
        if (opposite != Verdict::conditional) {
            EXPECT_NE(report::plain(verdict_text(rejudged)), report::plain(verdict_text(before))) << claim.id;
        }
        ++changed;
    }
    EXPECT_GT(changed, 20);
}

TEST(PlantedClaims, FalseOnesAreRefuted) {
    EXPECT_EQ(judged_verdict({"roughness left by steps of 1.5 limits", "", at_most, 1}, beyond_the_limit), Verdict::refuted);
    EXPECT_EQ(judged_verdict({"total curvature of a torus / 2π", "", at_least, 2}, total_curvature), Verdict::refuted);
    EXPECT_EQ(judged_verdict({"mean curvature of the unit sphere", "", at_least, 1.9}, sphere_curvature_measured), Verdict::refuted);
}

TEST(PlantedClaims, TrueOnesHold) {
    EXPECT_EQ(judged_verdict({"roughness left by steps of half the limit", "", at_most, 1}, below_the_limit), Verdict::holds);
    EXPECT_EQ(judged_verdict({"total curvature of a torus / 2π", "", at_most, 1e-9}, total_curvature), Verdict::holds);
    EXPECT_EQ(judged_verdict({"mean curvature of the unit sphere", "", at_least, 0.99}, sphere_curvature_measured), Verdict::holds);
}

TEST(ClaimList, EveryClaimIsComplete) {
    std::set<std::string_view> ids;
    std::set<std::string> sources;
    for (const Claim& claim : claim_list()) {
        SCOPED_TRACE(claim.id);
        EXPECT_TRUE(claim.id.starts_with("claims_"));
        EXPECT_TRUE(ids.insert(claim.id).second) << "twice";
        EXPECT_TRUE(claim.said().ends_with("."));
        EXPECT_NO_THROW(rule_text({&claim, {}, {}})) << "there is a message of its quantity";
        EXPECT_TRUE(std::isfinite(claim.rule.threshold));
        EXPECT_TRUE(claim.measure);
        EXPECT_NO_THROW(chapter_of_id(claim.question));
        const Source& source = claim.source();
        const bool report = source.name.size() == 2 && source.name[0] == 'S';
        EXPECT_EQ(source.citation.empty(), report) << "a paper is cited, a report is not";
        sources.insert(std::string(source.name));
    }
    EXPECT_GE(ids.size(), 45u);
    for (const char* source : {"S0", "S1", "S2", "S3"}) EXPECT_TRUE(sources.contains(source));
    EXPECT_GE(sources.size(), 8u) << "four reports, and papers";
}

// ---- what a claim is about ---------------------------------------------------------------------------------------------------

namespace {

/// A case with the number of meshes given; it decides every claim that is measured.
Measurement meshes_given(ClaimBench&, const MeshNames& meshes) {
    Measurement m;
    m.cases = {{"meshes", double(meshes.size())}};
    return m;
}

Decision decision_on(const MeshLibrary& library, const About& about) {
    const QuestionSettings settings = quick_settings();
    ClaimBench bench(library, settings);
    return judged(planted({"meshes measured", "", at_least, 1}, meshes_given, about), bench).decision;
}

const Claim& claim_named(std::string_view id) {
    const auto& claims = claim_list();
    const auto it = std::find_if(claims.begin(), claims.end(), [&](const Claim& claim) { return claim.id == id; });
    if (it == claims.end()) throw std::logic_error("no claim " + std::string(id));
    return *it;
}

Decision decision_of(std::string_view id, const MeshLibrary& library, const QuestionSettings& settings = {}) {
    ClaimBench bench(library, settings);
    return judged(claim_named(id), bench).decision;
}

/// True if the words of the claim name a mesh or a kind of mesh, or compare several meshes; independent of About.
bool names_what_a_mesh_is(const Claim& claim) {
    const std::string said = claim.said();
    const auto says = [&](const char* part) { return said.find(part) != std::string::npos; };
    return says("bunny") || says("cube") || says("cow") || says("fandisk") || says("plane") || says("Hands") || says("armadillo") ||
           says("Each object");
}

/// A closed surface with several bumps and triangles of all shapes.
TriangleMesh blob() {
    TriangleMesh mesh = icosphere(2);
    for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
        const Eigen::RowVector3d p = mesh.X.row(i);
        mesh.X.row(i) *= 1 + 0.4 * std::sin(3 * p[0] + 1) * std::cos(4 * p[1]) + 0.2 * std::sin(5 * p[2]);
    }
    return mesh;
}
TriangleMesh large_box() {
    TriangleMesh mesh = cube_mesh(6);
    mesh.X *= 7;
    return mesh;
}

}   // namespace

TEST(ClaimAbout, AClaimThatNamesAMeshIsNotAboutAnyMesh) {
    int naming = 0;
    for (const Claim& claim : claim_list()) {
        if (!names_what_a_mesh_is(claim)) continue;
        ++naming;
        EXPECT_FALSE(claim.about.meshes.empty()) << claim.id;
        EXPECT_TRUE(claim.about.scope != About::Scope::any_mesh || claim.about.compared > 1) << claim.id;
    }
    EXPECT_GE(naming, 15);
}

TEST(ClaimAbout, OneMeshInEveryRoleDecidesNothingAboutAnother) {
    for (const auto& [mesh, name] :
         {std::pair{large_box(), "about_box"}, std::pair{blob(), "about_blob"}, std::pair{grid_mesh(13, 14, 2, 1), "about_patch"}}) {
        const MeshLibrary library = library_of(mesh, name);
        const QuestionSettings settings;   // a full run: a quick one leaves most claims out
        ClaimBench bench(library, settings);
        int general = 0;
        for (const Claim& claim : claim_list()) {
            if (claim.about.meshes.empty()) continue;   // on surfaces that the program makes
            const JudgedClaim result = judged(claim, bench);
            const bool elsewhere = names_what_a_mesh_is(claim) || claim.about.scope != About::Scope::any_mesh || claim.about.compared > 1;
            if (elsewhere) {
                EXPECT_EQ(result.decision.verdict, Verdict::undecidable) << claim.id << " on " << name;
                EXPECT_NE(result.decision.why, "the quantity is not defined on this mesh")
                    << claim.id << ": a property excludes the mesh before it is measured";
            } else {
                general += result.decision.verdict != Verdict::undecidable ? 1 : 0;
            }
            EXPECT_EQ(result.decision.verdict == Verdict::undecidable, !result.decision.why.empty()) << claim.id;
        }
        EXPECT_GE(general, 15) << name << ": claims about any mesh are still decided";
    }
}

TEST(ClaimAbout, BundledMeshesDecideGeneralClaimsAndTheirKindsButNoOtherMeshItself) {
    const MeshLibrary library({}, {});
    const QuestionSettings settings = quick_settings();
    ClaimBench bench(library, settings);
    for (const Claim& claim : claim_list()) {
        if (claim.about.scope != About::Scope::itself) continue;
        EXPECT_EQ(judged(claim, bench).decision.verdict, Verdict::undecidable) << claim.id;
    }
    for (const char* id : {"claims_s0_limits_differ", "claims_s3_plane_uniform", "claims_s3_plane_step", "claims_s1_any_step"})
        EXPECT_NE(judged(claim_named(id), bench).decision.verdict, Verdict::undecidable) << id;
}

TEST(ClaimAbout, AMeshIsNotComparedWithItself) {
    const About two{{"bunny", "cube", "cow"}, {}, About::Scope::any_mesh, 2};
    EXPECT_EQ(decision_on(MeshLibrary({}, {}), two).verdict, Verdict::holds);
    const Decision own = decision_on(library_of(blob(), "about_alone"), two);
    EXPECT_EQ(own.verdict, Verdict::undecidable);
    EXPECT_EQ(own.why, "it compares different meshes, and here one takes the place of all");
    // One mesh under two names.
    const testing_tools::TemporaryFolder folder;
    write_mesh(folder.path() / "bunny.off", blob());
    write_mesh(folder.path() / "cow.off", blob());
    EXPECT_EQ(decision_on(MeshLibrary({folder.path()}, {}), {{"bunny", "cow"}, {}, About::Scope::any_mesh, 2}).verdict,
              Verdict::undecidable);
    EXPECT_EQ(decision_on(MeshLibrary({folder.path()}, {}), two).verdict, Verdict::holds) << "the cube is another";
}

TEST(ClaimAbout, AMeshIsIdentifiedByItsMeasuresAndNotByItsName) {
    const testing_tools::TemporaryFolder folder;
    write_mesh(folder.path() / "bunny.off", blob());
    const Decision impostor = decision_on(MeshLibrary({folder.path()}, {}), {{"bunny"}, {}, About::Scope::itself});
    EXPECT_EQ(impostor.verdict, Verdict::undecidable);
    EXPECT_EQ(impostor.why, "it is about bunny.off itself, and bunny says nothing about that mesh");
    TriangleMesh cube{Positions(8, 3), Faces(12, 3)};   // the bundled cube has other diagonals in its sides
    cube.X << -0.5, -0.5, 0.5, 0.5, -0.5, 0.5, -0.5, 0.5, 0.5, 0.5, 0.5, 0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, -0.5, -0.5, -0.5, 0.5, -0.5,
        -0.5;
    cube.F << 0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 4, 5, 6, 6, 5, 7, 6, 7, 0, 0, 7, 1, 1, 7, 3, 3, 7, 5, 6, 0, 4, 4, 0, 2;
    const About the_cube{{"cube"}, {}, About::Scope::itself};
    EXPECT_EQ(decision_on(MeshLibrary({}, {}), the_cube).verdict, Verdict::undecidable);
    EXPECT_EQ(decision_on(library_of(cube, "about_unit_cube"), the_cube).verdict, Verdict::holds) << "a copy of the mesh itself";
    cube.X *= 1.01;
    EXPECT_EQ(decision_on(library_of(cube, "about_other_cube"), the_cube).verdict, Verdict::undecidable);
}

TEST(ClaimAbout, AMeshWithoutThePropertyIsLeftOut) {
    const auto why = [](const TriangleMesh& mesh, const std::string& name, Property property) {
        return decision_on(library_of(mesh, name), {{"bunny"}, {property}}).why;
    };
    const TriangleMesh patch = grid_mesh(6, 5, 2, 1), sphere = icosphere(2);
    EXPECT_EQ(why(patch, "about_a", Property::flat), "");
    EXPECT_EQ(why(sphere, "about_b", Property::flat), "about_b is not flat");
    EXPECT_EQ(why(patch, "about_c", Property::not_flat), "about_c is flat");
    EXPECT_EQ(why(patch, "about_d", Property::closed), "about_d is open and encloses no volume");
    EXPECT_EQ(why(sphere, "about_e", Property::closed), "");
    EXPECT_EQ(why(sphere, "about_f", Property::flat_with_edges), "about_f has no flat parts with sharp edges between them");
    EXPECT_EQ(why(large_box(), "about_g", Property::flat_with_edges), "");
    EXPECT_NE(why(blob(), "about_r", Property::flat_with_edges), "") << "sharp here and there, and flat nowhere";
    EXPECT_EQ(why(sphere, "about_h", Property::negative_weights), "about_h has no negative cotangent weight");
    EXPECT_EQ(why(blob(), "about_i", Property::negative_weights), "");
    EXPECT_EQ(why(icosphere(0), "about_j", Property::unequal_areas), "about_j has vertices of equal areas");
    EXPECT_EQ(why(patch, "about_k", Property::unequal_areas), "");
    EXPECT_EQ(why(patch, "about_l", Property::above_1500_vertices), "about_l has no more than 1500 vertices");
    EXPECT_EQ(why(icosphere(4), "about_m", Property::above_1500_vertices), "");
    EXPECT_EQ(why(patch, "plane_noisy", Property::clean_known), "the surface under the noise of plane_noisy is not known")
        << "whatever the name of the user's file";
    EXPECT_EQ(decision_of("claims_s3_clamp_stable", library_of(sphere, "about_n")).verdict, Verdict::undecidable)
        << "there is no weight to clamp";
}

TEST(ClaimsSection, IsWellFormedOnTheBundledMeshes) {
    const Answer answer = chapter_of_id("claims").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    const report::Table& ledger = table_named(answer.section, "claims_ledger");
    EXPECT_EQ(ledger.rows.size(), claim_list().size());
    EXPECT_TRUE(ledger.sortable);
    const std::string prose = prose_of(answer.section);
    EXPECT_NE(prose.find("creature in place of bunny.off"), std::string::npos) << "the stand-in is named";
    EXPECT_NE(prose.find("a quick run does not measure it"), std::string::npos);
    const std::string first = report::plain(answer.section.answer);   // part of the opening table, which names no report
    for (const char* source : {"S0", "S1", "S2", "S3", "report"}) EXPECT_EQ(first.find(source), std::string::npos) << first;
}

TEST(ClaimsSection, IsWellFormedOnMeshesOfTheUser) {
    TriangleMesh one{Positions(3, 3), Faces(1, 3)};
    one.X << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    one.F << 0, 1, 2;
    TriangleMesh far = icosphere(2);
    far.X = (1e7 * far.X).rowwise() + Eigen::RowVector3d(1e12, -1e12, 1e12);
    for (const auto& [mesh, name] : {std::pair{one, "claim_triangle"}, std::pair{cube_mesh(1), "claim_box"}, std::pair{far, "claim_far"},
                                     std::pair{grid_mesh(6, 5, 2, 1), "claim_grid"}}) {
        SCOPED_TRACE(name);
        const Answer answer = chapter_of_id("claims").answer(library_of(mesh, name), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}

// ---- rules that test the claims --------------------------------------------------------------------------------------------

// The exactness of a clamped operator on a plane says nothing about its stability.
TEST(ClaimRules, ClampedWeightsAreJudgedByStability) {
    const MeshLibrary library({}, {});
    const QuestionSettings settings = quick_settings();
    ClaimBench bench(library, settings);
    const JudgedClaim claim = judged(claim_named("claims_s3_clamp"), bench);
    EXPECT_EQ(claim.decision.verdict, Verdict::holds) << "with weights ≥ 0 a step stays within the range of its input";
    EXPECT_GT(bench.plane().clamped, 0.1) << "although linear precision is lost";
    EXPECT_NE(report::plain(claim.measurement.remark).find("leaves the range by"), std::string::npos);
    EXPECT_EQ(report::plain(claim.measurement.remark).find("range by 0"), std::string::npos) << "negative weights do leave it";
}

// The final shape of the bundled stand-in is 1.53 % as thick as long.
TEST(ClaimRules, AThinShapeCountsAsALineAndASlabDoesNot) {
    const Rule& rule = claim_named("claims_s1_line").rule;
    EXPECT_TRUE(rule.satisfied_by(1.53));
    EXPECT_FALSE(rule.satisfied_by(20)) << "a slab";
}

// At noise level 20 smoothing removes two thirds of the noise; the rest is still more than a mean edge.
TEST(ClaimRules, NothingIsRecoveredOnlyWhereNoStepHelps) {
    const JudgedClaim little = [] {
        const MeshLibrary library = library_of(icosphere(4), "rule_ball");
        const QuestionSettings settings;
        ClaimBench bench(library, settings);
        return judged(claim_named("claims_s1_hopeless"), bench);
    }();
    EXPECT_EQ(little.decision.verdict, Verdict::refuted);
    EXPECT_GT(little.deciding_value(), 2);
    const Rule &none = claim_named("claims_s1_hopeless").rule, &some = claim_named("claims_s1_low_noise").rule;
    for (const double gain : {0.5, 1.1, 1.3, 3.0}) EXPECT_NE(none.satisfied_by(gain), some.satisfied_by(gain)) << "never both of a gain";
}

// The claim is about the order of loss, not about the error: on fine triangles an error of many mean edges is small.
TEST(ClaimRules, DetailsAreLostFirstOnlyWhereTheNoiseOutlivesThem) {
    const auto ratio_on = [](const TriangleMesh& mesh, const std::string& name) {
        const MeshLibrary library = library_of(mesh, name);
        const QuestionSettings settings;
        ClaimBench bench(library, settings);
        return judged(claim_named("claims_s2_too_much"), bench).deciding_value();
    };
    const auto with_bumps = [](double frequency) {
        TriangleMesh mesh = icosphere(4);
        for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
            const Eigen::RowVector3d p = mesh.X.row(i);
            mesh.X.row(i) *= 1 + 0.3 * std::sin(frequency * p[0]) * std::sin(frequency * p[1]);
        }
        return mesh;
    };
    const double fine = ratio_on(with_bumps(16), "rule_fine_bumps"), coarse = ratio_on(with_bumps(7), "rule_coarse_bumps");
    EXPECT_GT(fine, 1) << "the details vanish before the noise";
    EXPECT_LT(coarse, 1) << "the noise vanishes first, although it is as strong";
}

// ---- the meshes of the reports --------------------------------------------------------------------------------------------

namespace {

const std::filesystem::path mesh_folder = testing_tools::shared_mesh_folder();

JudgedClaim judged_on_originals(std::string_view id) {
    const MeshLibrary library({mesh_folder / "coursework", mesh_folder / "classic"}, {});
    const QuestionSettings settings;
    ClaimBench bench(library, settings);
    return judged(claim_named(id), bench);
}

bool originals_are_there() { return std::filesystem::exists(mesh_folder / "classic" / "bunny.off"); }

}   // namespace

#define NEEDS_ORIGINALS() \
    if (!originals_are_there()) GTEST_SKIP() << "no meshes at " << mesh_folder

// The numbers expected below were measured independently.

TEST(ClaimsOnOriginals, TheOriginalsHaveTheListedMeasures) {
    NEEDS_ORIGINALS();
    const MeshLibrary library({mesh_folder / "classic"}, {});
    for (const StandIn& entry : stand_in_list()) {
        const ReportMesh found = report_mesh(library, entry.name);
        ASSERT_TRUE(found.original) << entry.name;
        EXPECT_NEAR(found.mesh->prepared->preflight.mean_edge / entry.mean_edge, 1, 1e-5) << entry.name;
        EXPECT_NEAR(smoothing_subject(found.mesh).critical / entry.critical, 1, 1e-5) << entry.name;
        EXPECT_EQ(found.mesh->prepared->preflight.vertices_in_use, entry.vertices) << entry.name;
        EXPECT_EQ(found.mesh->prepared->preflight.triangles, entry.triangles) << entry.name;
    }
}

TEST(ClaimsOnOriginals, TheBunnyLimitMatchesWithTheFactorOneHalf) {
    NEEDS_ORIGINALS();
    const JudgedClaim claim = judged_on_originals("claims_s0_bunny_limit");
    EXPECT_EQ(claim.decision.verdict, Verdict::conditional);
    EXPECT_NEAR(claim.measurement.cases[0].value, 2e-7 / 1.93e-7, 0.005);
    EXPECT_NEAR(claim.measurement.cases[1].value, 2e-7 / 0.97e-7, 0.02);
}

TEST(ClaimsOnOriginals, BunnyZigzagsComeFromTheMissingHalfOrTheRebuiltOperator) {
    NEEDS_ORIGINALS();
    const JudgedClaim claim = judged_on_originals("claims_s0_bunny_zigzag");
    EXPECT_EQ(claim.decision.verdict, Verdict::conditional);
    ASSERT_EQ(claim.measurement.cases.size(), 3u);
    EXPECT_NEAR(2 * claim.measurement.cases[0].value, 1.04, 0.005);
    EXPECT_GT(2 * claim.measurement.cases[2].value, 14) << "λμ_max by step 50";
}

TEST(ClaimsOnOriginals, TheCubeShrinksAndIsNotUnstable) {
    NEEDS_ORIGINALS();
    const JudgedClaim claim = judged_on_originals("claims_s0_cube_too_large");
    EXPECT_EQ(claim.decision.verdict, Verdict::refuted);
    EXPECT_NEAR(claim.measurement.cases[0].value, 100 * 1e-3 / 0.247, 0.001);
    EXPECT_NEAR(100 - judged_on_originals("claims_s0_cube_deforms").measurement.cases.back().value, 76, 0.5) << "% of its size";
}

TEST(ClaimsOnOriginals, ExplicitEqualsImplicitAtTheSameStep) {
    NEEDS_ORIGINALS();
    const JudgedClaim claim = judged_on_originals("claims_s1_same_as_explicit");
    EXPECT_EQ(claim.decision.verdict, Verdict::holds);
    EXPECT_NEAR(claim.measurement.cases[0].value, 100 * 0.0014 / 0.40, 0.03);
}

TEST(ClaimsOnOriginals, MoreIterationsPartlyReplaceALargerStep) {
    NEEDS_ORIGINALS();
    const JudgedClaim claim = judged_on_originals("claims_s3_iterations_for_step");
    EXPECT_EQ(claim.decision.verdict, Verdict::conditional);
    EXPECT_NEAR(claim.measurement.cases.back().value, 100 * 0.054 / 0.40, 0.4);
}

TEST(ClaimsOnOriginals, UniformLimitsExplainTheReportsS2AndS3) {
    NEEDS_ORIGINALS();
    const JudgedClaim claim = judged_on_originals("claims_s2_unstable");
    EXPECT_EQ(claim.decision.verdict, Verdict::holds);
    EXPECT_NEAR(claim.measurement.cases[0].value, 1.5 / 1.36, 0.01);
    const JudgedClaim beyond = judged_on_originals("claims_s3_beyond_one");
    EXPECT_EQ(beyond.decision.verdict, Verdict::conditional);
    EXPECT_NEAR(beyond.measurement.cases[2].value, 1.5 / 1.34, 0.01);
}

TEST(ClaimsOnOriginals, IrregularTrianglesCostAQuarterOfTheCurvature) {
    NEEDS_ORIGINALS();
    const JudgedClaim claim = judged_on_originals("claims_s0_irregular");
    EXPECT_EQ(claim.decision.verdict, Verdict::refuted);
    for (const Case& c : claim.measurement.cases) EXPECT_NEAR(c.value, 27, 2.5) << c.condition;
}

TEST(ClaimsOnOriginals, NoiseMinimaComeInOrderButLater) {
    NEEDS_ORIGINALS();
    EXPECT_EQ(judged_on_originals("claims_s0_minima_order").decision.verdict, Verdict::holds);
    EXPECT_NE(judged_on_originals("claims_s0_minima").decision.verdict, Verdict::holds);
}

TEST(ClaimsOnOriginals, ThePlaneOfTheCourseIsFlat) {
    NEEDS_ORIGINALS();
    const JudgedClaim claim = judged_on_originals("claims_s3_plane_structure");
    EXPECT_EQ(claim.decision.verdict, Verdict::refuted);
    EXPECT_LT(claim.measurement.cases[0].value, 1e-12);
}

TEST(ClaimsOnOriginals, TheOtherClaimsHaveTheVerdictsMeasuredBefore) {
    NEEDS_ORIGINALS();
    EXPECT_EQ(judged_on_originals("claims_s0_nonlinear").decision.verdict, Verdict::refuted);
    EXPECT_EQ(judged_on_originals("claims_s3_tip").decision.verdict, Verdict::refuted);
    EXPECT_EQ(judged_on_originals("claims_s0_stable").decision.verdict, Verdict::holds);
    const JudgedClaim cheaper = judged_on_originals("claims_s0_cheaper");
    EXPECT_GT(cheaper.measurement.cases[0].value, 5) << "at equal λ and t implicit costs more: 0.39 s beside 0.03 s";
}

}   // namespace meshfolio::claims
