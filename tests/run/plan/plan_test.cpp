// Laws of a plan. What the models say of real runs is held by tests/bench/fit_costs.py --check.
#include "run/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "questions/core/chapter.h"

using namespace meshfolio;
using namespace meshfolio::run;

namespace {

constexpr double unlimited = 1e7;

ReportSettings settings_with(double time, bool quick = false) {
    ReportSettings settings;
    settings.time = time;
    settings.quick = quick;
    return settings;
}

Plan plan_of_size(double vertices, double time = unlimited, bool quick = false) {
    return plan_for(settings_with(time, quick), {{"a.obj", vertices}});
}

const PlannedSection& section(const Plan& plan, std::string_view id) {
    return *std::ranges::find(plan.sections, id, [](const PlannedSection& s) { return s.chapter->id; });
}

}   // namespace

TEST(CostModels, EachChapterHasOneThatNeverFallsWithSize) {
    for (const Chapter* chapter : chapter_list()) {
        const auto& [cpu, memory, whole, lengths, length, runs, is_guess] = chapter->cost;
        for (const CostModel& cost : {cpu.full, cpu.small, memory.full, memory.small, whole})
            EXPECT_TRUE(cost.fixed >= 0 && cost.linear >= 0 && cost.growing >= 0) << chapter->id;
        EXPECT_GT(cpu.small.fixed + cpu.small.per_mesh(1e5), 0) << chapter->id << " has no cost: tests/bench/fit_costs.py prints it";
        EXPECT_GE(cpu.full.fixed + cpu.full.per_mesh(1e5), cpu.small.fixed + cpu.small.per_mesh(1e5)) << chapter->id;
        EXPECT_LE(chapter->planned_roles, chapter->roles.size()) << chapter->id;
    }
}

TEST(CostModels, AChapterWithoutOneHasAGuessAndThePlanSaysSo) {
    const Chapter eighth{.id = "q8", .code = {}, .answer = nullptr};
    Plan plan;
    plan.sections = {{&eighth, {{"a.obj", 1e4}}}};
    EXPECT_GT(plan.sections.front().effort().cpu_seconds, 1);
    EXPECT_GT(plan.sections.front().memory(), 10 * megabyte);
    EXPECT_NE(text_of(plan).find("its cost is a guess"), std::string::npos);
    EXPECT_EQ(text_of(plan_for(report_settings({}), plan.meshes)).find("guess"), std::string::npos) << "every chapter of ours has one";
}

TEST(Plan, ALargerMeshNeverCostsLess) {
    for (const bool quick : {false, true}) {
        double before = 0, memory = 0;
        for (double vertices = 10; vertices < 1e7; vertices *= 1.7) {
            const Plan plan = plan_of_size(vertices, unlimited, quick);
            EXPECT_GE(plan.cpu_seconds(), before) << vertices;
            EXPECT_GE(plan.memory(), memory) << vertices;
            before = plan.cpu_seconds(), memory = plan.memory();
        }
    }
}

TEST(Plan, MoreTimeNeverGivesLess) {
    for (const double vertices : {2e3, 4.3e4, 1.7e5, 2.8e6}) {
        std::vector<std::size_t> rungs;
        for (double time = 1; time < 1e6; time *= 1.3) {
            const Plan plan = plan_of_size(vertices, time);
            for (std::size_t i = 0; i < plan.sections.size(); ++i) {
                const std::size_t rung = plan.sections[i].rung;
                EXPECT_LE(rung, i < rungs.size() ? rungs[i] : 99)
                    << plan.sections[i].chapter->id << " of " << vertices << " in " << time << " s";
                rungs.resize(std::max(rungs.size(), i + 1));
                rungs[i] = rung;
            }
        }
        EXPECT_EQ(*std::ranges::max_element(rungs), 0u) << "whole, with time enough";
    }
}

TEST(Plan, ItFitsOrNothingIsLeftToScaleDownAndEveryQuestionIsAnswered) {
    for (const double vertices : {2e3, 4.3e4, 2.8e6}) {
        for (const double time : {0.1, 10.0, 60.0, 300.0}) {
            const Plan plan = plan_of_size(vertices, time);
            for (const PlannedSection& planned : plan.sections)
                EXPECT_FALSE(planned.effort().left_out && planned.chapter->is_question()) << planned.chapter->id;
            EXPECT_TRUE(plan.seconds() <= time || section(plan, "stability").effort().left_out) << vertices << " in " << time << " s";
        }
    }
}

TEST(Plan, CostsAddUp) {
    const Plan plan = plan_of_size(5e4);
    double sum = plan.rest_cpu();
    for (const auto& [id, effort] : plan.efforts()) sum += effort.cpu_seconds;
    EXPECT_NEAR(plan.cpu_seconds(), sum, 1e-9);
    const Plan two = plan_for(settings_with(unlimited), {{"a.obj", 5e4}, {"b.obj", 2e4}}), other = plan_of_size(2e4);
    for (const PlannedSection& planned : plan.sections) {
        const std::string_view id = planned.chapter->id;
        const double fixed = planned.chapter->cost.cpu.full.fixed;
        EXPECT_NEAR(section(two, id).effort().cpu_seconds - fixed,
                    planned.effort().cpu_seconds + section(other, id).effort().cpu_seconds - 2 * fixed, 1e-9)
            << id;
    }
}

TEST(Plan, TheSameInputHasTheSameBytes) {
    EXPECT_EQ(json_of(plan_of_size(5e4, 60)), json_of(plan_of_size(5e4, 60)));
    EXPECT_NE(json_of(plan_of_size(5e4, 60)), json_of(plan_of_size(5e4, 20)));
    const auto json = nlohmann::json::parse(json_of(plan_of_size(5e6, 60)));
    EXPECT_EQ(json["sections"].size(), chapter_list().size());
}

TEST(Plan, APartIsDoneAsInTheWhole) {
    ReportSettings settings = settings_with(100);
    const Plan whole = plan_for(settings, {{"a.obj", 2e5}});
    settings.only = {"q6"};
    const Plan part = plan_for(settings, {{"a.obj", 2e5}});
    ASSERT_EQ(part.sections.size(), 1u);
    EXPECT_GT(part.sections.front().rung, 0u);
    EXPECT_EQ(part.sections.front().rung, section(whole, "q6").rung);
}

TEST(Plan, NamedSectionsAreKeptAndOmittedOnesAreReported) {
    ReportSettings settings = settings_with(5, true);
    const std::vector<PlannedMesh> meshes{{"a.obj", 2e5}};
    const Plan whole = plan_for(settings, meshes);
    ASSERT_TRUE(section(whole, "stability").effort().left_out);
    settings.only = {"q1", "stability"};
    const Plan part = plan_for(settings, meshes);
    EXPECT_FALSE(section(part, "stability").effort().left_out);
    EXPECT_GT(section(part, "stability").effort().cpu_seconds, 0);
    double sum = part.rest_cpu();
    for (const auto& [id, effort] : part.efforts()) {
        sum += effort.cpu_seconds;
        if (id == "stability") continue;
        const Effort in_whole = whole.efforts().at(id);
        EXPECT_EQ(effort.left_out, in_whole.left_out) << id;
        EXPECT_EQ(effort.most_vertices, in_whole.most_vertices) << id;
    }
    EXPECT_NEAR(part.cpu_seconds(), sum, 1e-9) << "the others cost nothing";
}

TEST(Plan, ASectionAloneTakesWhatAPartOfItTakes) {
    ReportSettings settings = settings_with(100);
    const std::vector<PlannedMesh> meshes{{"a.obj", 2e5}};
    for (const auto& section : nlohmann::json::parse(json_of(plan_for(settings, meshes)))["sections"]) {
        settings.only.assign(1, section["id"].get<std::string>());
        const auto part = nlohmann::json::parse(json_of(plan_for(settings, meshes)));
        for (const char* cost : {"cpu_seconds", "memory_bytes"}) EXPECT_EQ(section["alone"][cost], part[cost]) << settings.only.front();
    }
}

TEST(Plan, AnAskedQuestionAndItsSettingsCount) {
    ReportSettings settings = settings_with(unlimited);
    settings.only = {"q4"};
    const double usual = plan_for(settings, {{"a.obj", 1e4}}).cpu_seconds();
    settings.questions["q4"].k = {5, 600};
    EXPECT_GT(plan_for(settings, {{"a.obj", 1e4}}).cpu_seconds(), usual);
    EXPECT_EQ(plan_for(settings, {{"a.obj", 1e4}}).sections.size(), 1u);
}

TEST(Plan, AQuickReportKeepsWhatItPromises) {
    for (const auto& [triangles, seconds] : {std::pair(1e4, 20.0), {1e5, 20.0}, {1e6, 60.0}, {5.5e6, 180.0}}) {
        EXPECT_NEAR(promised_seconds(triangles, true), seconds, 1e-9);
        ReportSettings settings;
        settings.quick = true;
        settings.pdf = "off";
        const Plan plan = plan_for(settings, {{"a.obj", triangles / 2}});
        EXPECT_LE(plan.seconds(), seconds) << triangles;
        EXPECT_LT(plan.memory(), 8e9) << triangles;
        for (const auto& [id, effort] : plan.efforts()) EXPECT_FALSE(effort.left_out) << id << " of " << triangles;
    }
    ReportSettings usual;
    EXPECT_LE(plan_for(usual, {{"a.obj", 173e3}}).seconds(), 180);
}

TEST(Plan, EffortsArePartOfWhatAnAnswerIsStoredUnder) {
    ReportSettings settings;
    const auto before = identity_of(settings, "q4");
    settings.efforts["q4"] = {.small = false, .most_vertices = 10000};
    EXPECT_NE(identity_of(settings, "q4"), before);
    EXPECT_EQ(described(settings).at("q4 effort"), "full settings, copies of at most 10000 vertices");
    EXPECT_EQ(identity_of(settings, "q5"), identity_of(ReportSettings(), "q5")) << "of this question alone";
}

TEST(Plan, TooLittleMemoryIsRefusedWithASizeThatFits) {
    const ReportSettings settings = settings_with(unlimited);
    const Plan plan = plan_for(settings, {{"a.obj", 2.8e6}});
    EXPECT_NO_THROW(require_memory(plan, settings, {1e12, "MemAvailable"}));
    EXPECT_NO_THROW(require_memory(plan, settings, {})) << "not known";
    try {
        require_memory(plan, settings, {0.5 * plan.memory(1), "RLIMIT_AS"});
        FAIL();
    } catch (const InputError& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find("RLIMIT_AS"), std::string::npos) << what;
        EXPECT_NE(what.find("would fit"), std::string::npos) << what;
    }
    EXPECT_NO_THROW(require_memory(plan_of_size(100), settings, {1e6, "RLIMIT_AS"})) << "so little is tried";
}
