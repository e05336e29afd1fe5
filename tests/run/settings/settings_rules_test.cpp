// The rules of settings files, a row for each: a text and all messages about it. A text with any message sets nothing, and the exit code
// is that of wrong usage.
#include <gtest/gtest.h>

#include <algorithm>

#include "questions/core/chapter.h"
#include "run/settings/report_settings.h"
#include "run/settings/settings_problems.h"
#include "run/settings/settings_reader.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::run;

namespace {

/// Returns the messages without the name of the file: "12: problem; remedy".
std::vector<std::string> lines_of_problems(const std::string& text) {
    constexpr std::string_view file = "my.toml:";
    std::vector<std::string> lines = testing_tools::problems_of(text);
    for (std::string& line : lines) {
        EXPECT_TRUE(line.starts_with(file)) << line;
        EXPECT_EQ(line.find_first_of("\n\x1b"), std::string::npos) << line;
        line.erase(0, file.size());
    }
    return lines;
}

struct Rule {
    const char* name;
    std::string text;
    std::vector<std::string> lines;   // the beginning of each line, in order
};

std::string times(int count, std::string_view part) {
    std::string text;
    for (int i = 0; i < count; ++i) text += part;
    return text;
}

const std::string q4 = "[[question]]\nid = \"q4\"\n";

/// Adds values of `output` that are refused.
void add_outputs(std::vector<Rule>& rules) {
    for (const std::string name : {"..", "../x", "/tmp/x", "a/b", ".hidden", "", "a b", "-o", "x\\\\y"})
        rules.push_back({"output", q4 + "output = \"" + name + "\"", {"3: [[question]] output '" + name.substr(0, 2)}});
    for (const std::string name : {"images", "tables", "index.html", "SHA256SUMS", "results.json"})
        rules.push_back(
            {"output", q4 + "output = \"" + name + "\"", {"3: [[question]] output '" + name + "' collides with a part of the report"}});
}

std::vector<Rule> rules() {
    std::vector<Rule> rules{
        {"nothing", "", {}},
        {"comment", "# only a comment", {}},
        // unknown keys and tables, with the nearest known one of their kind
        {"key", "treads = 1", {"1: unknown key 'treads'; did you mean 'threads'?"}},
        {"table", "[reprot]\n", {"1: unknown table 'reprot'; did you mean 'report'?"}},
        {"table that is like a key", "[bogus]\nx = 1", {"1: unknown table 'bogus'; did you mean '"}},
        {"list of tables", "[[questin]]\nid = \"q1\"", {"1: unknown table 'questin'; did you mean 'question'?"}},
        {"table within a table", "[report.page]\nx = 1", {"1: unknown table 'page' in [report]; [report] has no tables within it"}},
        {"key in a table", "[render]\nsise = 64", {"2: unknown key 'sise' in [render]; did you mean 'size'?"}},
        {"key in a question", q4 + "lamda = 1", {"3: unknown key 'lamda' in [[question]]; did you mean 'lambda'?"}},
        {"dotted key", "report.titel = \"x\"", {"1: unknown key 'titel' in [report]; did you mean 'title'?"}},
        {"quoted key", "\"\" = 1", {"1: unknown key ''"}},
        {"long key", std::string(500, 'k') + " = 1", {"1: unknown key 'kkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkk…'"}},
        // wrong types
        {"text for a number", "seed = \"1\"", {"1: seed is a text, not an integer"}},
        {"number for a text", "[report]\ntitle = 1", {"2: [report] title is an integer, not a text"}},
        {"fraction", "threads = 1.0", {"1: threads is a number with a fraction, not an integer"}},
        {"truth", "laboratory = \"yes\"", {"1: laboratory is a text, not true or false"}},
        {"truth for a number", "threads = true", {"1: threads is a truth value, not an integer"}},
        {"number for a file", q4 + "mesh = 4", {"3: [[question]] mesh is an integer, not a text"}},
        {"list in a list", q4 + "k = [5, [6]]", {"3: [[question]] k[1] is a list, not an integer"}},
        {"date", q4 + "noise = 2001-01-01", {"3: [[question]] noise is a date or time, not a number"}},
        {"table for a value", "seed = {}", {"1: seed is a table, not an integer"}},
        {"value for a table", "render = 3", {"1: render is not a table; write [render]"}},
        {"value for [report]", "report = 1", {"1: report is not a table; write [report]"}},
        {"[[report]]", "[[report]]\ntitle = \"x\"", {"1: report is not a table; write [report]"}},
        {"value for questions", "question = 1", {"1: question is not a list of tables; write [[question]] above each"}},
        {"list for a text", "[report]\nauthor = [\"a\"]", {"2: [report] author is a list, not a text"}},
        {"list for a number", "seed = [1]", {"1: seed is a list, not an integer"}},
        {"number for a truth", "laboratory = 1", {"1: laboratory is an integer, not true or false"}},
        {"number for a template", "[report]\ntemplate = 1", {"2: [report] template is an integer, not a text"}},
        {"number for a colour map", "[render]\ncolormap = 1", {"2: [render] colormap is an integer, not a text"}},
        {"text for a size", "[render]\nsize = \"large\"", {"2: [render] size is a text, not an integer"}},
        {"number for an id", "[[question]]\nid = 4", {"2: [[question]] id is an integer, not a text"}},
        {"number for an output", q4 + "output = 1", {"3: [[question]] output is an integer, not a text"}},
        {"number among meshes", q4 + "mesh = [\"a\", 4]", {"3: [[question]] mesh[1] is an integer, not a text"}},
        {"fraction for k", q4 + "k = 5.5", {"3: [[question]] k is a number with a fraction, not an integer"}},
        {"text for k", q4 + "k = \"five\"", {"3: [[question]] k is a text, not an integer"}},
        {"text for iterations", q4 + "iterations = \"many\"", {"3: [[question]] iterations is a text, not an integer"}},
        {"text among steps", q4 + "lambda = [1, \"a\"]", {"3: [[question]] lambda[1] is a text, not a number"}},
        {"truth among noises", q4 + "noise = [0.1, true]", {"3: [[question]] noise[1] is a truth value, not a number"}},
        {"seed and threads of a question",
         q4 + "seed = 1.5\nthreads = -1",
         {"3: [[question]] seed is a number with a fraction, not an integer",
          "4: [[question]] threads = -1 is out of range; it may be from 0 to 1024"}},
        {"[question]", "[question]\nid = \"q9\"", {"1: question is not a list of tables", "2: [[question]] id: 'q9' is unknown"}},
        {"mixed list of questions",
         "question = [{id = \"q9\"}, 3]",
         {"1: [[question]] id: 'q9' is unknown", "1: question[1] is an integer, not a table; write [[question]] above each"}},
        {"empty list of questions", "question = []", {"1: question is not a list of tables"}},
        // every wrong element of a list is reported on its own line
        {"sections",
         "[report]\nsections = [\"q1\", \"q9\", 3]",
         {"2: [report] sections: 'q9' is unknown; did you mean '", "2: [report] sections[2] is an integer, not a text"}},
        {"sections over lines",
         "[report]\nsections = [\n  \"q1\",\n  \"q9\",\n  \"q1\"\n]",
         {"4: [report] sections: 'q9' is unknown", "5: [report] sections: 'q1' is given twice"}},
        {"size",
         "[render]\nsize = [8, \"x\", 64]",
         {"2: [render] size[0] = 8 is out of range", "2: [render] size[1] is a text, not an integer", "2: [render] size has 3 values"}},
        {"one side in a list", "[render]\nsize = [64]", {"2: [render] size has one value in a list; write N or [W, H]"}},
        {"no sections", "[report]\nsections = []", {"2: [report] sections is an empty list; fill it, or leave the key out"}},
        {"no template",
         "[report]\ntemplate = \"\"",
         {"2: [report] template cannot be read: it is an empty path; name a file, or leave the key out"}},
        {"no size", "[render]\nsize = []", {"2: [render] size is an empty list"}},
        {"a camera with a text and too many degrees",
         "[render]\ncamera = [\"front\", 361]",
         {"2: [render] camera[0] is a text, not a number", "2: [render] camera[1] = 361 is out of range; it may be from -360 to 360"}},
        {"elevation", "[render]\ncamera = [0, 91]", {"2: [render] camera[1] = 91 is out of range; an elevation may be from -90 to 90"}},
        {"one angle", "[render]\ncamera = 35", {"2: [render] camera has 1 value; write [azimuth, elevation] or "}},
        {"four angles", "[render]\ncamera = [1, 2, 3, 4]", {"2: [render] camera has 4 values; write [azimuth, elevation] or "}},
        {"no camera", "[render]\ncamera = []", {"2: [render] camera is an empty list"}},
        {"text for a camera", "[render]\ncamera = \"35,22\"", {"2: [render] camera is a text, not a number"}},
        {"the whole sight",
         "[render]\nup = \"w\"\nzoom = [1, 2]\ncamra = [1, 2]\ncamera = [1, nan]",
         {"2: [render] up: 'w' is unknown; did you mean '", "3: [render] zoom is a list; give one number",
          "4: unknown key 'camra' in [render]; did you mean 'camera'?", "5: [render] camera[1] is not finite"}},
        {"number for up", "[render]\nup = 1", {"2: [render] up is an integer, not a text"}},
        {"no k", q4 + "k = []", {"3: [[question]] k is an empty list"}},
        {"no meshes", q4 + "mesh = []", {"3: [[question]] mesh is an empty list"}},
        {"no steps", q4 + "lambda = []", {"3: [[question]] lambda is an empty list"}},
        {"no iterations", q4 + "iterations = []", {"3: [[question]] iterations is an empty list"}},
        {"no noise", q4 + "noise = []", {"3: [[question]] noise is an empty list"}},
        {"no mesh", q4 + "mesh = \"\"", {"3: [[question]] mesh is an empty path"}},
        {"long list", q4 + "k = [1" + times(100, ", 1") + "]", {"3: [[question]] k has 101 values; at most 100 are allowed"}},
        {"k",
         q4 + "k = [0, 5, \"x\"]",
         {"3: [[question]] k[0] = 0 is out of range; it may be from 1 to 100000", "3: [[question]] k[2] is a text"}},
        {"meshes",
         q4 + "mesh = [\"\", 1, \"a\", \"a\"]",
         {"3: [[question]] mesh is an empty path", "3: [[question]] mesh[1] is an integer", "3: [[question]] mesh 'a' is given twice"}},
        // not finite, or out of range, with the limits
        {"nan", q4 + "lambda = nan", {"3: [[question]] lambda is not finite"}},
        {"inf", q4 + "noise = [inf, -inf]", {"3: [[question]] noise[0] is not finite", "3: [[question]] noise[1] is not finite"}},
        {"zero step", q4 + "lambda = 0", {"3: [[question]] lambda = 0 is out of range; it may be above 0 and at most 1e100"}},
        {"too much noise", q4 + "noise = 10.5", {"3: [[question]] noise = 10.5 is out of range; it may be from 0 to 10"}},
        {"too many iterations",
         q4 + "iterations = 100001",
         {"3: [[question]] iterations = 100001 is out of range; it may be from 1 to 100000"}},
        {"threads", "threads = 9223372036854775807", {"1: threads = 9223372036854775807 is out of range; it may be from 0 to 1024"}},
        {"integer beyond TOML", "seed = 9223372036854775808", {"1: "}},
        {"seed of a question", q4 + "seed = -1", {"3: [[question]] seed = -1 is out of range; it may be from 0 to 9223372036854775807"}},
        {"title of 200 bytes", "[report]\ntitle = \"" + std::string(200, 'x') + "\"", {}},
        {"title", "[report]\ntitle = \"" + std::string(201, 'x') + "\"", {"2: [report] title has 201 bytes; at most 200 are allowed"}},
        {"control character", "[report]\nauthor = \"a\\u001bb\"", {"2: [report] author has a control character"}},
        {"second line", "[report]\ntitle = \"a\\nb\"", {"2: [report] title has a control character"}},
        {"delete", "[report]\ncourse = \"a\\u007fb\"", {"2: [report] course has a control character"}},
        {"control character in a key", "\"\\u001b[31mred\" = 1", {"1: unknown key '\\x1b[31mred'"}},
        {"colour map", "[render]\ncolormap = \"vridis\"", {"2: [render] colormap: 'vridis' is unknown; did you mean 'viridis'?"}},
        // questions
        {"twice", q4 + q4, {"4: question 'q4' is given twice"}},
        {"no id", "[[question]]\nk = 5", {"1: [[question]] has no id"}},
        {"no id, other things too", "[[question]]\nk = 0", {"1: [[question]] has no id", "2: [[question]] k = 0"}},
        // outputs
        {"output with NUL", q4 + "output = \"a\\u0000\"", {"3: [[question]] output 'a\\x00' is not a plain name"}},
        {"same output",
         q4 + "output = \"a\"\n[[question]]\nid = \"q5\"\noutput = \"a\"",
         {"6: [[question]] output 'a' collides with that of line 3"}},
        // templates
        {"no template", "[report]\ntemplate = \"none.html\"", {"2: [report] template cannot be read: none.html: cannot open the file"}},
        {"folder for a template", "[report]\ntemplate = \"/\"", {"2: [report] template cannot be read: /: is a folder"}},
        {"template with NUL", "[report]\ntemplate = \"/etc/passwd\\u0000x\"", {"2: [report] template cannot be read: "}},
        // TOML itself
        {"same key twice", "seed = 1\nseed = 2", {"2: "}},
        {"no value", "seed = 1\nthreads = \n", {"2: "}},
        {"no digits", "seed = 1\nthreads = 0x_1\n", {"2: "}},
        {"unclosed text", "[report]\ntitle = \"x\n", {"2: "}},
        {"unclosed key", "seed = 1\n\"unclosed\n", {"2: "}},
        {"unclosed list", "[render]\nsize = [1, 2\n", {"2: "}},
        {"text that is not UTF-8", "[report]\ntitle = \"\xff\"", {"2: "}},
        {"not UTF-8", "# \xff", {"1: "}},
        {"UTF-16", std::string("\xff\xfes\0e\0", 6), {"1: "}},
        {"NUL", std::string("seed = 1\n\0", 10), {"2: "}},
        {"nested values",
         "x = " + times(5000, "[") + times(5000, "]"),
         {"1: Error while parsing value: exceeded maximum nested value depth of 64"}},
        {"nested keys",
         "[report]\n" + std::string(200000, 'a') + "= 1\nx" + times(100000, ".x") + " = 1",
         {"3: a key has more than 16 parts between dots"}},
        {"nested tables", "[a.b . c.d.e.\"f.g\".h.i.j.'k'.l.m.n.o.p.q.r.s]", {"1: a key has more than 16 parts"}},
    };
    add_outputs(rules);
    return rules;
}

}   // namespace

TEST(SettingsRules, EachTextHasExactlyTheseProblems) {
    for (const Rule& rule : rules()) {
        const std::vector<std::string> lines = lines_of_problems(rule.text);
        std::string all;
        for (const std::string& line : lines) all += "\n  " + line;
        EXPECT_EQ(lines.size(), rule.lines.size()) << rule.name << all;
        for (std::size_t i = 0; i < std::min(lines.size(), rule.lines.size()); ++i)
            EXPECT_TRUE(lines[i].starts_with(rule.lines[i])) << rule.name << ": " << lines[i];
    }
}

TEST(SettingsRules, EveryProblemHasARemedy) {
    for (const Rule& rule : rules()) {
        for (const std::string& line : lines_of_problems(rule.text)) {
            EXPECT_TRUE(line.find("; ") != std::string::npos || line.find("cannot be read") != std::string::npos)
                << rule.name << ": " << line;
        }
    }
}

TEST(SettingsRules, DotsInTextsAndCommentsAreNotPartsOfKeys) {
    const std::string dots(100, '.');
    for (const std::string& text :
         {"# " + dots, "title = \"" + dots + "\"", "title = '" + dots + "'", "title = \"\"\"\n" + dots + "\"\"\"\"\"",
          "title = '''" + dots + "'''", "title = \"\\\"" + dots + "\"",
          std::string("a = [1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5]")}) {
        EXPECT_EQ(line_of_long_key(text), 0) << text;
    }
    const std::string parts = times(20, ". a");
    for (const std::string before : {"x = \"\"\"a\"\"\"\"\n", "x = 'a\\'\n", "x = \"a\\\\\"\n", "# \"\n", "x = {"}) {
        EXPECT_GT(line_of_long_key(before + "a" + parts), 0) << before;
    }
}

TEST(SettingsRules, ProblemsOfTheCommandLineAndTheFileAreReportedTogether) {
    const testing_tools::TemporaryFolder folder;
    ReportFlags flags;
    flags.config = (folder.path() / "none.toml").string();
    flags.size = "8";
    flags.threads = "x";
    flags.only = "q5,,q9,q5";
    try {
        report_settings(flags);
        FAIL();
    } catch (const SettingsErrors& errors) {
        const std::vector<std::string> beginnings{flags.config + ": cannot open the file",
                                                  "--size '8' is not an integer from 16 to 4096",
                                                  "--threads 'x' is not an integer from 0 to 1024",
                                                  "--only 'q5,,q9,q5' has a comma with nothing",
                                                  "--only: 'q9' is unknown",
                                                  "--only: 'q5' is given twice"};
        ASSERT_EQ(errors.problems().size(), beginnings.size());
        for (std::size_t i = 0; i < beginnings.size(); ++i)
            EXPECT_TRUE(std::string(errors.problems()[i].what()).starts_with(beginnings[i]));
    }
    for (const char* only : {",", "q1,", ",q1", "q1 ,q2"}) {
        ReportFlags wrong;
        wrong.only = only;
        EXPECT_THROW(report_settings(wrong), UsageError) << only;
    }
}

// The smallest and the largest value of each number are accepted, values beyond them are not.
TEST(SettingsRules, LimitsAgreeWithTheMessages) {
    const std::vector<std::pair<std::string, std::pair<std::vector<std::string>, std::vector<std::string>>>> keys{
        {"threads = ", {{"0", "1024"}, {"-1", "1025"}}},
        {"seed = ", {{"0", "9223372036854775807"}, {"-1"}}},
        {"[render]\nsize = ", {{"16", "4096"}, {"15", "4097"}}},
        {"[render]\nzoom = ", {{"0.01", "1", "100"}, {"0", "0.0099", "100.1", "-1"}}},
        {"[render]\ncamera = ",
         {{"[-360, -90]", "[360.0, 90.0, -360]", "[0, 0, 360]"}, {"[361, 0]", "[0, -90.5]", "[0, 0, -361]", "[0, inf]"}}},
        {q4 + "k = ", {{"1", "100000"}, {"0", "100001"}}},
        {q4 + "iterations = ", {{"1", "100000"}, {"0", "100001"}}},
        {q4 + "lambda = ", {{"5e-324", "1e100"}, {"0", "-0.0", "1.0000001e100", "1e-400", "nan", "-inf"}}},
        {q4 + "noise = ", {{"0", "-0.0", "10"}, {"-5e-324", "10.000001", "-nan", "inf"}}},
    };
    for (const auto& [key, values] : keys) {
        for (const std::string& good : values.first) EXPECT_EQ(lines_of_problems(key + good).size(), 0u) << key << good;
        for (const std::string& bad : values.second) EXPECT_EQ(lines_of_problems(key + bad).size(), 1u) << key << bad;
    }
}
