#include "questions/certificates/planted_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "mesh/samples/sample_shapes.h"

namespace meshfolio::certificates {
namespace {

const Specimen& specimen() {
    static const Specimen sound = ellipsoid_specimen();
    return sound;
}

const std::vector<report::Check>& sound_checks() {
    static const std::vector<report::Check> checks = checks_of(specimen());
    return checks;
}

const PlantedFault& fault_named(const std::vector<PlantedFault>& faults, const std::string& part) {
    const auto it = std::find_if(faults.begin(), faults.end(), [&](const auto& f) { return f.name.find(part) != std::string::npos; });
    if (it == faults.end()) throw std::logic_error("no fault " + part);
    return *it;
}

}   // namespace

TEST(PlantedFaults, SoundDataPassesEveryCheck) {
    EXPECT_GE(sound_checks().size(), 18u);
    for (const report::Check& check : sound_checks()) EXPECT_TRUE(check.passed()) << check.name << ": " << check.measured;
}

class EachFault : public ::testing::TestWithParam<PlantedFault> {};

TEST_P(EachFault, IsCaughtByItsCheck) {
    const FaultTrial trial = trial_of(specimen(), sound_checks(), GetParam());
    EXPECT_TRUE(trial.caught()) << trial.sound.name << ": " << trial.sound.measured << " sound, " << trial.faulty.measured << " faulty";
    EXPECT_TRUE(trial.sound.passed());
    EXPECT_EQ(trial.sound.name, GetParam().check);
    EXPECT_NE(trial.sound.measured, trial.faulty.measured);
    EXPECT_TRUE(check_of(trial).passed());
    EXPECT_NE(check_of(trial).name.find(GetParam().name), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(PlantedFaults, EachFault, ::testing::ValuesIn(planted_faults()), [](const auto& test) {
    std::string name = test.param.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')); },
        '_');
    return name;
});

// A named check that cannot see its fault must be reported as not caught.
TEST(PlantedFaults, ABlindCheckDoesNotCatchItsFault) {
    const std::vector<PlantedFault> faults = planted_faults();
    for (const auto& [part, blind] :
         {std::pair{"½ missing", law("symmetric")}, std::pair{"½ missing", law("row_sums")}, std::pair{"one face reversed", law("mass")},
          std::pair{"one mode dropped", law("orthonormal")}, std::pair{"areas twice", law("energy")}}) {
        PlantedFault fault = fault_named(faults, part);
        const std::string right = fault.check;
        fault.check = blind;
        const FaultTrial trial = trial_of(specimen(), sound_checks(), fault);
        EXPECT_FALSE(trial.caught()) << part << " by " << blind;
        EXPECT_FALSE(check_of(trial).passed());
        EXPECT_NE(std::find(trial.also_seen_by.begin(), trial.also_seen_by.end(), right), trial.also_seen_by.end());
    }
}

TEST(PlantedFaults, WithoutAFaultNothingIsCaught) {
    for (const report::Check& check : sound_checks()) {
        const FaultTrial trial = trial_of(specimen(), sound_checks(), {"nothing", check.name, [](Specimen&) {}});
        EXPECT_FALSE(trial.caught()) << check.name;
        EXPECT_TRUE(trial.also_seen_by.empty()) << check.name;
    }
}

TEST(PlantedFaults, ACheckThatFailsAnywayCatchesNothing) {
    Specimen unsound = specimen();
    unsound.laplacian.M *= 2;
    const PlantedFault fault = fault_named(planted_faults(), "areas twice");
    EXPECT_FALSE(trial_of(unsound, checks_of(unsound), fault).caught());
}

TEST(PlantedFaults, AnUnknownCheckIsAnError) {
    EXPECT_THROW(trial_of(specimen(), sound_checks(), {"x", "no such check", [](Specimen&) {}}), std::logic_error);
}

TEST(PlantedFaults, EveryCheckIsNeededForSomeFault) {
    std::set<std::string> needed;
    for (const PlantedFault& fault : planted_faults()) needed.insert(fault.check);
    for (const report::Check& check : sound_checks()) EXPECT_TRUE(needed.contains(check.name)) << "never seen to fail: " << check.name;
}

TEST(PlantedFaults, AreCaughtOnAnotherShapeToo) {
    TriangleMesh torus = torus_mesh(40, 17, 2, 0.7);
    torus.X.col(0) *= 1.3;   // without symmetry: no two eigenvalues are equal
    torus.X.col(2) += 0.2 * torus.X.col(1).cwiseAbs2();
    const Specimen genus_one = sound_specimen(torus);
    const std::vector<report::Check> sound = checks_of(genus_one);
    for (const report::Check& check : sound) EXPECT_TRUE(check.passed()) << check.name << ": " << check.measured;
    for (const PlantedFault& fault : planted_faults()) EXPECT_TRUE(trial_of(genus_one, sound, fault).caught()) << fault.name;
}

}   // namespace meshfolio::certificates
