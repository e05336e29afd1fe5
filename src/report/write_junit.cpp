// The checks as JUnit XML, for CI: what the schemas of Jenkins and of Windy Road both take.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "report/escape.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

std::string attribute(const std::string& name, const std::string& value) {
    return " " + name + "=\"" + xml_escape(safe_text(value)) + "\"";
}

/// @param outcome  an element; empty: passed
std::string test_case(const std::string& section, const std::string& name, const std::string& outcome) {
    const std::string head = "    <testcase" + attribute("classname", "meshfolio." + section) + attribute("name", name) + " time=\"0\"";
    return head + (outcome.empty() ? "/>\n" : ">" + outcome + "</testcase>\n");
}

std::string outcome_of(const Check& check) {
    const std::string note = check.note.empty() ? "" : " (" + check.note + ")";
    const std::string message = attribute("message", check.name + ": " + words_of(check) + note);
    if (check.passed()) return "";
    return check.failed() ? "<failure type=\"check\"" + message + "/>" : "<skipped" + message + "/>";
}

/// Seconds as an XML decimal, to the millisecond.
std::string decimal(double seconds) {
    const std::string milliseconds = std::to_string(1000 + std::llround(1000 * seconds) % 1000).substr(1);
    return std::to_string(std::llround(1000 * seconds) / 1000) + "." + milliseconds;
}

std::string suite_of(const Section& section, std::size_t number, bool timings) {
    const Score score = score_of(section.checks);
    const std::size_t broken = section.status == Status::failed ? 1 : 0, left_out = section.status == Status::skipped ? 1 : 0;
    const std::vector<std::string> ids = check_ids(section);
    std::string cases;
    if (broken == 1) cases += test_case(section.id, section.id, "<error type=\"section\"" + attribute("message", section.failure) + "/>");
    if (left_out == 1) cases += test_case(section.id, section.id, "<skipped" + attribute("message", section.extent) + "/>");
    for (std::size_t i = 0; i < ids.size(); ++i) cases += test_case(section.id, ids[i], outcome_of(section.checks[i]));
    const double seconds = timings && !section.timings.empty() ? section.timings.back().seconds : 0;
    const auto count = [](const std::string& name, std::size_t n) { return attribute(name, std::to_string(n)); };
    return "  <testsuite" + attribute("name", section.id + ": " + section.title) + count("id", number) + " package=\"meshfolio\"" +
           " timestamp=\"1970-01-01T00:00:00\" hostname=\"localhost\"" + count("tests", score.total() + broken + left_out) +
           count("failures", score.failed) + count("errors", broken) + count("skipped", score.undecided + left_out) +
           attribute("time", decimal(seconds)) + ">\n    <properties/>\n" + cases +
           "    <system-out/>\n    <system-err/>\n  </testsuite>\n";
}

}   // namespace

std::string write_junit(const Document& document, bool timings) {
    std::string suites;
    for (std::size_t i = 0; i < document.sections.size(); ++i) suites += suite_of(document.sections[i], i, timings);
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n";
}

}   // namespace meshfolio::report
