#include "questions/bench/law_checks.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/curvature/curvature.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

bool has(const std::vector<report::Check>& checks, const std::string& name) {
    return std::any_of(checks.begin(), checks.end(), [&](const report::Check& c) { return c.name.starts_with(name); });
}

SpectrumCertificate good_certificate() {
    SpectrumCertificate c;
    c.pairs = c.counted_below = c.found_below = 7;
    c.complete = Proof::proved;
    c.delta = 1e-12;
    c.gap = 1;
    c.zero_eigenvalues = c.expected_zeros = 1;
    return c;
}

}   // namespace

TEST(LawChecks, ACertificateHoldsExactlyWhereItsChecksPass) {
    const auto all_pass = [](const SpectrumCertificate& c) {
        const auto checks = spectrum_checks(c, " on x");
        return std::all_of(checks.begin(), checks.end(), [](const report::Check& check) { return check.passed(); });
    };
    const auto any_fails = [](const SpectrumCertificate& c) {
        const auto checks = spectrum_checks(c, " on x");
        return std::any_of(checks.begin(), checks.end(), [](const report::Check& check) { return check.failed(); });
    };
    EXPECT_TRUE(good_certificate().holds() && all_pass(good_certificate()));
    for (void (*damage)(SpectrumCertificate&) :
         {+[](SpectrumCertificate& c) { c.residual = 2e-8; }, +[](SpectrumCertificate& c) { c.orthonormality_error = 1e-8; },
          +[](SpectrumCertificate& c) { c.parseval_gap = 1e-8; },
          +[](SpectrumCertificate& c) { c.counted_below = 8, c.complete = Proof::refuted; },
          +[](SpectrumCertificate& c) { c.zero_eigenvalues = 2; }, +[](SpectrumCertificate& c) { c.smallest_step_up = -1e-6; }}) {
        SpectrumCertificate c = good_certificate();
        damage(c);
        EXPECT_EQ(c.verdict(), Proof::refuted);
        EXPECT_TRUE(any_fails(c));
    }
    for (void (*open)(SpectrumCertificate&) :
         {+[](SpectrumCertificate& c) { c.counted_below = -1, c.complete = Proof::undecided; },
          +[](SpectrumCertificate& c) { c.counted_below = 9, c.delta = 2, c.complete = Proof::undecided; },
          +[](SpectrumCertificate& c) { c.residual = 2e-3, c.residual_limit = 1e-3, c.residual_rounding = 1; }}) {
        SpectrumCertificate c = good_certificate();
        open(c);
        EXPECT_EQ(c.verdict(), Proof::undecided);
        EXPECT_FALSE(all_pass(c) || any_fails(c));
        c.parseval_gap = 1;
        EXPECT_EQ(c.verdict(), Proof::refuted);
        EXPECT_TRUE(any_fails(c));
    }
    SpectrumCertificate cut = good_certificate();   // k cuts a cluster: the proof is that below it none is missing
    cut.counted_below = cut.found_below = 5;
    EXPECT_TRUE(cut.holds() && all_pass(cut));
    SpectrumCertificate broken = good_certificate();
    broken.residual = broken.parseval_gap = infinity;
    EXPECT_FALSE(broken.holds() || all_pass(broken));
}

TEST(LawChecks, ChecksOnlyTheClaimedProperties) {
    const TriangleMesh sphere = icosphere(2);
    const Vector deficits = angle_deficit(sphere, topology_of(sphere));
    EXPECT_EQ(surface_checks(sphere, deficits, {}, "").size(), 4u);
    const auto open = surface_checks(sphere, deficits, {.closed = false}, "");
    EXPECT_TRUE(has(open, law("half_edges")) && has(open, law("gauss_bonnet")));
    EXPECT_FALSE(has(open, law("flux")) || has(open, law("outward")));
    const auto moebius = surface_checks(sphere, deficits, {.orientable = false}, "");
    EXPECT_TRUE(has(moebius, law("gauss_bonnet")));
    EXPECT_EQ(moebius.size(), 1u);
    EXPECT_TRUE(surface_checks(sphere, deficits, {.manifold = false}, "").empty());
}

TEST(LawChecks, LeavesOutEnergyLawsWithTrianglesWithoutArea) {
    const TriangleMesh sphere = icosphere(2);
    const auto whole = operator_checks(sphere, laplace_beltrami(sphere), " on ball"),
               floored = operator_checks(sphere, laplace_beltrami(sphere), "", 3);
    EXPECT_TRUE(has(whole, law("energy")) && has(whole, law("first_variation")));
    EXPECT_FALSE(has(floored, law("energy")) || has(floored, law("first_variation")));
    for (const report::Check& check : whole) EXPECT_TRUE(check.passed() && check.name.ends_with(" on ball")) << check.name;
}
