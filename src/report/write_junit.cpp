// The checks as JUnit XML for CI, valid by the schemas of Jenkins and of Windy Road.
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "report/batch/batch.h"
#include "report/escape.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

std::string attribute(const std::string& name, const std::string& value) {
    return " " + name + "=\"" + xml_escape(safe_text(value)) + "\"";
}

/// Returns a <testcase>. @param outcome  an element; empty: passed
std::string test_case(const std::string& section, const std::string& name, const std::string& outcome) {
    const std::string head = "    <testcase" + attribute("classname", "meshfolio." + section) + attribute("name", name) + " time=\"0\"";
    return head + (outcome.empty() ? "/>\n" : ">" + outcome + "</testcase>\n");
}

/// A <testsuite> of one or several sections.
class Suite {
public:
    /// @param group  prefix of its cases: "q1"
    Suite(std::string name, std::string group) : name_(std::move(name)), group_(std::move(group)) {}

    void add(const Section& section) {
        if (section.status == Status::failed) add_error(section.id, "section", section.failure);
        if (section.status == Status::skipped) {
            cases_ += test_case(group_, section.id, "<skipped" + attribute("message", section.extent) + "/>");
            ++left_out_;
        }
        const std::vector<std::string> ids = check_ids(section);
        for (std::size_t i = 0; i < ids.size(); ++i) {
            const Check& check = section.checks[i];
            const std::string note = check.note.empty() ? "" : " (" + check.note + ")";
            const std::string words = check.name + ": " + words_of(check) + note, message = attribute("message", words) + "/>";
            measured_ += xml_escape(safe_text(ids[i] + ": " + words)) + "\n";
            cases_ += test_case(group_, ids[i],
                                check.passed()   ? ""
                                : check.failed() ? "<failure type=\"check\"" + message
                                                 : "<skipped" + message);
        }
        score_ += score_of(section.checks);
    }
    void add_error(const std::string& name, const std::string& kind, const std::string& message) {
        cases_ += test_case(group_, name, "<error" + attribute("type", kind) + attribute("message", message) + "/>");
        ++broken_;
    }

    std::string text(std::size_t number, double seconds) const {
        const auto count = [](const std::string& name, std::size_t n) { return attribute(name, std::to_string(n)); };
        const long long milliseconds = std::llround(1000 * seconds);
        const std::string time = std::to_string(milliseconds / 1000) + "." + std::to_string(1000 + milliseconds % 1000).substr(1);
        return "  <testsuite" + attribute("name", name_) + count("id", number) + " package=\"meshfolio\"" +
               " timestamp=\"1970-01-01T00:00:00\" hostname=\"localhost\"" + count("tests", score_.total() + broken_ + left_out_) +
               count("failures", score_.failed) + count("errors", broken_) + count("skipped", score_.undecided + left_out_) +
               attribute("time", time) + ">\n    <properties/>\n" + cases_ + "    <system-out>" + measured_ +
               "</system-out>\n    <system-err/>\n  </testsuite>\n";
    }

private:
    std::string name_, group_, cases_;
    std::string measured_;   // a line for each check, as cases that passed have no message in both schemas
    Score score_;
    std::size_t broken_ = 0, left_out_ = 0;
};

std::string junit_of(const std::string& suites) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n";
}

}   // namespace

std::string write_junit(const Document& document, bool timings) {
    std::string suites;
    for (std::size_t i = 0; i < document.sections.size(); ++i) {
        const Section& section = document.sections[i];
        Suite suite(section.id + ": " + section.title, section.id);
        suite.add(section);
        suites += suite.text(i, timings && !section.timings.empty() ? section.timings.back().seconds : 0);
    }
    return junit_of(suites);
}

std::string write_batch_junit(const Batch& batch) {
    std::string suites;
    for (std::size_t i = 0; i < batch.rows.size(); ++i) {
        const BatchRow& row = batch.rows[i];
        Suite suite(row.name + ": " + row.file, row.name);
        if (row.state == BatchRow::State::failed) suite.add_error("report", "mesh", row.error);
        for (const Section& section : row.sections) suite.add(section);
        const auto* seconds = std::get_if<double>(&row.seconds);
        suites += suite.text(i, seconds != nullptr ? *seconds : 0);
    }
    return junit_of(suites);
}

}   // namespace meshfolio::report
