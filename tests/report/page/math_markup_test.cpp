#include "report/page/math_markup.h"

#include <gtest/gtest.h>

namespace meshfolio::report {
namespace {

/// λ_crit → "<λ>_(crit)": variables in <>, vectors in **, indices in _(), exponents in ^().
std::string sketch(const std::string& math) {
    std::string text;
    for (const MathPart& part : math_parts(math)) {
        switch (part.kind) {
            case MathPart::Kind::upright: text += part.text; break;
            case MathPart::Kind::variable: text += "<" + part.text + ">"; break;
            case MathPart::Kind::vector: text += "*" + part.text + "*"; break;
            case MathPart::Kind::subscript: text += "_(" + part.text + ")"; break;
            case MathPart::Kind::superscript: text += "^(" + part.text + ")"; break;
        }
    }
    return text;
}

TEST(MathMarkup, SplitsIndicesAndExponents) {
    EXPECT_EQ(sketch("λ_crit = 2/μ_max"), "<λ>_(crit) = 2/<μ>_(max)");
    EXPECT_EQ(sketch("h^2 + x_{i,j}"), "<h>^(2) + *x*_(i,j)");
    EXPECT_EQ(sketch("k^−1/2"), "<k>^(−1)/2");
    EXPECT_EQ(sketch("ΔX"), "Δ<X>");
}

TEST(MathMarkup, FunctionsAndWordsAreUpright) {
    EXPECT_EQ(sketch("sin v du"), "sin <v> <du>");
    EXPECT_EQ(sketch("volume"), "volume");
}

TEST(MathMarkup, OddInputsKeepTheirCharacters) {
    EXPECT_EQ(sketch(""), "");
    EXPECT_EQ(sketch("_"), "_");
    EXPECT_EQ(sketch("_a"), "_<a>");
    EXPECT_EQ(sketch("a_"), "<a>_");
    EXPECT_EQ(sketch("x_ y"), "*x*_ <y>");
    EXPECT_EQ(sketch("x^{open"), "*x*^(open)");
    EXPECT_EQ(sketch("φ_λ"), "<φ>_(λ)");
}

TEST(MathMarkup, VectorsAreKnownByTheirNames) {
    EXPECT_EQ(sketch("Lx ≈ −2Hn"), "<L>*x* ≈ −2<H>*n*");
    EXPECT_EQ(sketch("−p·n"), "−*p*·*n*");
    EXPECT_EQ(sketch("p"), "<p>");
    EXPECT_EQ(sketch("h̄²"), "<h̄>²");
}

/// Symbols between ⟨ and ⟩.
std::string marked(const std::string& words) {
    std::string text;
    for (const Run& run : prose(words)) text += run.kind == Run::Kind::math ? "⟨" + run.content + "⟩" : run.content;
    return text;
}

TEST(MathMarkup, FindsSymbolsInProse) {
    EXPECT_EQ(marked("growth at 1.01 λ_crit on fandisk_ns"), "growth at 1.01 ⟨λ_crit⟩ on fandisk_ns");
    EXPECT_EQ(marked("K = a²/(b²c²), k = 5 of 9"), "⟨K = a²/(b²c²)⟩, ⟨k = 5⟩ of 9");
    EXPECT_EQ(marked("as (1 + λμ)^−t, 2π − Σθ (where σ = 0.2\u202f% is)"), "as ⟨(1 + λμ)^−t⟩, ⟨2π − Σθ⟩ (where ⟨σ = 0.2\u202f%⟩ is)");
    EXPECT_EQ(marked("(u, v) to cos θ; |Σ A n|, χ = V − edges"), "(⟨u⟩, ⟨v⟩) to ⟨cos θ⟩; |Σ ⟨A⟩ ⟨n⟩|, ⟨χ = V⟩\u00a0−\u00a0edges");
    EXPECT_EQ(marked("uniform H and K, where θ is"), "uniform ⟨H⟩ and ⟨K⟩, where ⟨θ⟩ is");
    EXPECT_EQ(marked("½‖Δx‖ times 4/h²"), "⟨½‖Δx‖⟩ times ⟨4/h²⟩");
    EXPECT_EQ(marked("the mean edge h̄: λt/h̄²"), "the mean edge ⟨h̄⟩: ⟨λt/h̄²⟩");
    EXPECT_EQ(marked("(a, 0, 0), a cap"), "(⟨a⟩, 0, 0), a cap");
    EXPECT_EQ(prose("λ_ and μ").size(), 3u);
}

TEST(MathMarkup, NamesUnitsAndLabelsAreNoSymbols) {
    for (const std::string words : {"along y, +x and ±z", "9.8 s, 23 B, 4 m", "b: explicit. c: implicit", "S1, x-ray.k, b.obj, C++",
                                    "e.g. i.e.", "the cow's", "k-means is e.V", "M. Desbrun", "A mesh. I say a word", "q4_modes"})
        EXPECT_EQ(prose(words).size(), 1u) << marked(words);
    EXPECT_EQ(plain(prose("κ_n over θ, \xff_x")), "κ_n over θ, \xff_x");
    EXPECT_EQ(marked("k = n gives"), "⟨k⟩\u00a0=\u00a0n gives");
}

TEST(MathMarkup, NoLineBreaksAtRelationsOrBeforeUnits) {
    EXPECT_EQ(plain(prose("the size = 1.70, in 9.8 s or 5 %")), "the size\u00a0=\u00a01.70, in 9.8\u00a0s or 5\u00a0%");
    EXPECT_EQ(plain(prose("K × edge − 1 < 2 · 3")), "K\u00a0×\u00a0edge\u00a0−\u00a01\u00a0<\u00a02\u00a0·\u00a03");
    EXPECT_EQ(plain(prose("of 5 shapes = ")), "of 5 shapes\u00a0=\u00a0");
}

}   // namespace
}   // namespace meshfolio::report
