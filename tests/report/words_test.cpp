#include "report/words.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "base/errors.h"
#include "report/test_tools.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

using namespace literals;

std::vector<std::string> paragraphs_of(const std::string& text) { return messages_of("## key\n" + text, "file").front().paragraphs; }

/// Tells the message with every section but `left_out`: with its marks closed, and no gap where a section is not told.
void expect_readable(const Message& message, const std::string& left_out, const std::string& file) {
    const std::vector<std::string> names = facts_in(message);
    Facts facts;
    for (const std::string& name : names) facts.emplace_back(name, name == left_out ? 0 : 1);
    for (const std::string& paragraph : message.paragraphs) {
        if (paragraph.starts_with("$$")) continue;
        std::string told;
        ASSERT_NO_THROW(told = plain(running_text(paragraph, facts))) << file << ": " << message.key;
        for (const char* gap : {"  ", " .", " ,", "..", "()", ", ."})
            EXPECT_EQ(told.find(gap), told.npos) << file << ": " << message.key << " without " << left_out << ": " << told;
    }
}

}   // namespace

TEST(Words, EmptyLinesSeparateParagraphs) {
    EXPECT_EQ(paragraphs_of("one\n  two\n\nthree\n# a remark\nfour"), (std::vector<std::string>{"one two", "three", "four"}));
    EXPECT_EQ(paragraphs_of("one\n### Title\ntwo\n$$ formula $$\n- a\n  b\n- c"),
              (std::vector<std::string>{"one", "### Title", "two", "$$ formula $$", "- a b", "- c"}));
}

TEST(Words, ASentenceNeedsAKey) { EXPECT_THROW(messages_of("# remark\nA sentence.\n", "file"), UsageError); }

TEST(Words, FindsTheFactsOfAMessage) {
    const Message message = messages_of("## key\n{{b}} of {{a}} {{a|one|many}} [[q3_{{id}}]]", "file").front();
    EXPECT_EQ(facts_in(message), (std::vector<std::string>{"a", "b", "id"}));
}

TEST(Words, MarkupBecomesRuns) {
    const Text expected = text("The limit ", math("λ_crit = 3"), " is ", strong("here"), ", ", emphasis("so"), " ", code("call()"), " (",
                               ref("q3_ball"), ") * $.");
    EXPECT_EQ(
        running_text("The limit $λ_crit = {{n}}$ is **here**, *so* `call()` ([[q3_{{mesh}}]]) \\* \\$.", {"n"_a = 3, "mesh"_a = "ball"}),
        expected);
}

TEST(Words, FactsAreNoMarkup) {
    EXPECT_EQ(running_text("on {{mesh}}", {"mesh"_a = "a*b$c[[d"}), text("on a*b$c[[d"));
    EXPECT_EQ(running_text("on {{mesh}}.", {"mesh"_a = text("the ", strong("cube"))}), text("on the ", strong("cube"), "."));
}

TEST(Words, CountsChooseSingularOrPlural) {
    const auto of = [](int n) { return plain(running_text("{{n}} {{n|mesh has|meshes have}}", {"n"_a = n})); };
    EXPECT_EQ(of(1), "1 mesh has");
    EXPECT_EQ(of(0), "0 meshes have");
    EXPECT_EQ(of(12), "12 meshes have");
    EXPECT_EQ(of(40962), "40\u202f962 meshes have");
    EXPECT_THROW(running_text("{{n|mesh|meshes}}", {"n"_a = "1"}), std::logic_error) << "no count";
}

TEST(Words, SectionsDependOnTheirFacts) {
    const auto told = [](const Facts& facts) {
        return plain(running_text(
            "{{#spots}}On {{spots}} it is a spot.{{/spots}} {{^spots}}Nowhere.{{/spots}} {{#flips}}It flips.{{/flips}}", facts));
    };
    EXPECT_EQ(told({"spots"_a = "cube", "flips"_a = true}), "On cube it is a spot. It flips.");
    EXPECT_EQ(told({"spots"_a = text(math("x")), "flips"_a = 0}), "On x it is a spot.");
    EXPECT_EQ(told({"spots"_a = "", "flips"_a = 3}), "Nowhere. It flips.");
    EXPECT_EQ(told({"spots"_a = Text(), "flips"_a = false}), "Nowhere.");
    EXPECT_THROW(told({"spots"_a = ""}), std::logic_error) << "whether it flips is not known";
    EXPECT_THROW(running_text("{{#open}}for ever", {"open"_a = true}), std::logic_error);
    EXPECT_EQ(running_line("a{{#b}}, **b** {{n}}{{/b}}", {"b"_a = true, "n"_a = 2}), "a, **b** 2");
}

TEST(Words, AListRepeatsItsSection) {
    const auto told = [](const FactList& meshes) {
        return running_text("{{#meshes}}**{{mesh}}** has {{limit}}{{#flat}} and is flat{{/flat}}. {{/meshes}}{{^meshes}}None.{{/meshes}}",
                            {"meshes"_a = meshes, "limit"_a = "the limit"});
    };
    EXPECT_EQ(told({}), text("None."));
    EXPECT_EQ(told({{"mesh"_a = "a", "flat"_a = true}, {"mesh"_a = "b", "flat"_a = false, "limit"_a = "another"}}),
              text(strong("a"), " has the limit and is flat. ", strong("b"), " has another."));
    EXPECT_THROW(running_text("{{meshes}}", {"meshes"_a = FactList{}}), std::logic_error) << "a list is no word";
}

TEST(Words, EmptyParagraphsAreLeftOut) {
    const Message message = messages_of("## key\n{{#a}}One.{{/a}}\n\n{{^a}}Other.{{/a}}\n", "file").front();
    EXPECT_EQ(facts_in(message), std::vector<std::string>{"a"});
    const std::vector<Block> blocks = blocks_of(message, {"a"_a = false});
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_EQ(plain(std::get<Paragraph>(blocks[0]).text), "Other.");
}

TEST(Words, NoLineBreaksBetweenANumberAndItsPercentSign) {
    EXPECT_EQ(plain(running_text("{{error}} % of 95 %, in % of the edge", {"error"_a = "1.5"})),
              "1.5\u202f% of 95\u202f%, in % of the edge");
}

TEST(Words, MissingKeysAndFactsAreLogicErrors) {
    EXPECT_THROW(Words("q3").say("no such message"), std::logic_error);
    EXPECT_THROW(Words("no such file").say("title"), std::logic_error);
    EXPECT_THROW(Words("q3").line("plane.caption"), std::logic_error) << "without its fact";
}

// The user's own text is data: it has no facts, and refers to questions alone.
TEST(OwnBlocks, ReadsParagraphsListsHeadingsAndFormulas) {
    const auto blocks = own_blocks("# Head\r\nFirst\nline, \\* plain.\n\n- a\n* b\n1. one\n2. two\n$$ λ ≤ 2/μ $$\nSee [[q5]].");
    ASSERT_EQ(blocks.size(), 7u);
    EXPECT_EQ(std::get<Paragraph>(blocks[0]).text, text(strong("Head")));
    EXPECT_EQ(std::get<Paragraph>(blocks[1]).text, text("First line, * plain."));
    EXPECT_EQ(std::get<BulletList>(blocks[2]).items, (std::vector<Text>{text("a"), text("b")}));
    EXPECT_EQ(std::get<Paragraph>(blocks[4]).text, text("2. two"));
    EXPECT_EQ(std::get<Paragraph>(blocks[5]).text, text(math("λ ≤ 2/μ")));
    EXPECT_EQ(std::get<Paragraph>(blocks[6]).text, text("See ", ref("q5"), "."));
    EXPECT_TRUE(own_blocks("").empty());
    EXPECT_TRUE(own_blocks("\n \n").empty());
}

TEST(OwnBlocks, WhatCannotBeReadIsALogicError) {
    for (const char* bad :
         {"{{fact}}", "{{#a}}b{{/a}}", "**open", "- *open", "[[truth]]", "[[q5_limits]]", "$$", "$$ x", "$$$$", "# **open"})
        EXPECT_THROW(own_blocks(bad), std::logic_error) << bad;
}

TEST(Words, ACaptionHasNoReference) {
    int tried = 0;
    for (const Message& message : messages_of(Templates()["words/q5.md"], "q5.md")) {
        if (message.paragraphs.size() != 1 || message.paragraphs.front().find("[[") == std::string::npos) continue;
        Facts facts;
        const std::vector<std::string> names = facts_in(message);
        for (const std::string& name : names) facts.emplace_back(name, 1);
        EXPECT_NO_THROW(Words("q5").say(message.key, facts));
        EXPECT_THROW(Words("q5").line(message.key, facts), UsageError) << "a reference would be printed as it is written";
        ++tried;
    }
    EXPECT_GT(tried, 0);
}

TEST(Words, EveryMessageOfTheProgramCanBeRead) {
    const Templates templates;
    for (const std::string& name : templates.names()) {
        if (!name.starts_with("words/")) continue;
        for (const Message& message : messages_of(templates[name], name)) {
            EXPECT_FALSE(message.paragraphs.empty()) << name << ": " << message.key;
            expect_readable(message, "", name);
            for (const std::string& paragraph : message.paragraphs)
                for (const std::string& section : matches(paragraph, "\\{\\{[#^](\\w+)")) expect_readable(message, section, name);
        }
    }
}

TEST(Words, AMessageBecomesBlocks) {
    const auto blocks = Words("q3").blocks("method", {});
    ASSERT_GE(blocks.size(), 3u);
    EXPECT_EQ(std::get<Heading>(blocks[0]).title, "Method");
    EXPECT_EQ(std::get<Formula>(blocks[2]), (Formula{"cotangent_weights", "q3_eq_weights"}));
}

TEST(Words, ATemplateReplacesAMessageAndKeepsTheOthers) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "words");
    folder.write("words/q3.md", "## plane.caption\nN = {{vertices}}\n");
    use_words_of(Templates(folder.path()));
    EXPECT_EQ(Words("q3").line("plane.caption", "vertices"_a = 7), "N = 7");
    EXPECT_EQ(Words("q3").line("title"), "Cotangent Laplace–Beltrami curvature");
    EXPECT_NE(words_identity(), "");
    use_words_of(Templates());
    EXPECT_TRUE(Words("q3").line("plane.caption", "vertices"_a = 7, "undefined"_a = "").starts_with("|H| × mean edge of flat meshes"));
    EXPECT_EQ(words_identity(), "");
}

TEST(Words, UnusableReplacedMessagesAreRefusedWithTheirLine) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "words");
    const auto problem_of = [&](const std::string& text) -> std::string {
        folder.write("words/q3.md", text);
        try {
            use_words_of(Templates(folder.path()));
        } catch (const UsageError& error) {
            return error.what();
        }
        return "none";
    };
    EXPECT_NE(problem_of("## title\nA\n## tittle\nB\n").find("q3.md:3"), std::string::npos);
    EXPECT_NE(problem_of("## plane.caption\n{{edges}}\n").find("edges"), std::string::npos);
    EXPECT_NE(problem_of("## plane.caption\n{{vertices|vertex|vertices}}\n## value_on\n{{value|one|many}}\n").find("q3.md:3: "),
              std::string::npos);
    EXPECT_NE(problem_of("## title\nA\n\n## title\nB\n").find("q3.md:4"), std::string::npos);
    EXPECT_NE(problem_of("## title\n{{unclosed\n"), "none");
    EXPECT_NE(problem_of("## title\n**unclosed\n"), "none");
    use_words_of(Templates());
}

}   // namespace meshfolio::report
