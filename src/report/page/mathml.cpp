#include "report/page/mathml.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "report/escape.h"
#include "report/page/math_markup.h"

namespace meshfolio::report {

namespace {

constexpr long longest_unbroken = 25;   // characters
constexpr std::size_t deepest = 40;     // nested fences

const Pairs symbols =
    pairs_in(R"(\alpha α \beta β \Delta Δ \varepsilon ε \theta θ \kappa κ \mu μ \pi π \sigma σ \Phi Φ \varphi φ \chi χ \cdot · \times ×
    \pm ± \cap ∩ \ni ∋ \le ≤ \ge ≥ \ne ≠ \approx ≈ \sim ∼ \succ ≻ \top ⊤ \circ ° \emptyset ∅ \dots … \sum ∑ \leftarrow ←
    \Rightarrow ⇒ \langle ⟨ \rangle ⟩ \Leftrightarrow ⇔ \lVert ‖ \rVert ‖ \backslash ∖ \lambda λ \in ∈ \gamma γ \delta δ \rho ρ \tau τ \omega ω \nabla ∇ \partial ∂ \infty ∞ \to → \propto ∝ \int ∫)");
const Pairs spaces = pairs_in("\\, 0.167 \\; 0.278 ~ 0.167 \u202f 0.167 \\quad 1 \\qquad 2");
const Pairs accents = pairs_in("\\hat ^ \\tilde ~ \\bar ¯ \u0302 ^ \u0303 ~ \u0304 ¯");   // the last three follow their letter

struct Atom {
    enum class Kind { ordinary, function, sign, relation, comma, large, fence, space, blank, none };
    Kind kind = Kind::ordinary;
    std::string xml;       // of a sign, a relation and a comma the bare character
    bool tall = false;     // taller than a line
    bool limits = false;   // scripts stand below and above, where there is room
};
using Kind = Atom::Kind;
using Row = std::vector<Atom>;

bool is_one_of(std::string_view c, std::string_view set) { return !c.empty() && set.find(c) != std::string_view::npos; }
bool is_bar(std::string_view c) { return is_one_of(c, "|‖"); }
bool opens(std::string_view c) { return is_one_of(c, "([⟨") || c == "\\{"; }
bool closes(std::string_view c) { return is_one_of(c, ")]⟩") || c == "\\}"; }

Kind kind_of(std::string_view c) {
    if (is_one_of(c, "+−-±·×∩/")) return Kind::sign;
    if (is_one_of(c, "=<>≤≥≠≈∼≻∈∋←→⇒⇔∝:")) return Kind::relation;
    return is_one_of(c, ",;") ? Kind::comma : Kind::ordinary;
}

std::string element(const std::string& name, const std::string& inside, const std::string& attributes = "") {
    return "<" + name + attributes + ">" + inside + "</" + name + ">";
}
bool is_tall(const Row& atoms) { return std::ranges::any_of(atoms, &Atom::tall); }
bool is_operator(Kind kind) { return kind == Kind::sign || kind == Kind::relation || kind == Kind::comma; }
bool is_letter_like(Kind kind) { return kind == Kind::ordinary || kind == Kind::fence || kind == Kind::large; }
std::string space(const std::string& width) { return "<mspace width=\"" + width + "em\"/>"; }

/// Reads TeX once, token by token, and writes MathML.
class Writer {
public:
    Writer(std::string_view tex, std::string name) : tex_(tex), name_(std::move(name)) { advance(); }

    std::string all(bool broken = false) {
        const std::string xml = joined(row(), broken);
        if (!token_.empty()) fail("'" + token_ + "' is out of place");
        return xml;
    }

private:
    std::string_view tex_;
    std::string name_;                // for messages
    std::string token_;               // a command, a number, or one character; empty at the end
    int depth_ = 0;                   // of scripts, where nothing is spaced
    std::vector<std::string> open_;   // fences around the place, in this group

    [[noreturn]] void fail(const std::string& problem) const {
        throw UsageError("formula " + name_ + ": " + problem,
                         "write it like the other formulas of the file, or give it a \"mathml\" of its own", {"formulas.json", 0});
    }

    void advance() {
        while (tex_.starts_with(' ')) tex_.remove_prefix(1);
        std::size_t end = math_character(tex_, 0);
        if (tex_.starts_with('\\') && tex_.size() > 1) {
            while (end < tex_.size() && is_letter(tex_[end])) ++end;
            end = std::max<std::size_t>(end, 2);
        }
        while (!tex_.empty() && is_digit(tex_[0]) && end < tex_.size() && (is_digit(tex_[end]) || tex_[end] == '.')) ++end;
        if (end > 1 && tex_[end - 1] == '.') --end;
        token_ = tex_.substr(0, end);
        tex_.remove_prefix(end);
        if (token_ == "\\left" || token_ == "\\right") return advance();
        if (const auto symbol = symbols.find(token_); symbol != symbols.end()) token_ = symbol->second;
    }

    /// Returns the text between braces, not interpreted.
    std::string words() {
        const std::size_t end = tex_.find('}');
        if (token_ != "{" || end == std::string_view::npos) fail("a group {…} is missing");
        std::string inside(tex_.substr(0, end));
        tex_.remove_prefix(end + 1);
        advance();
        return inside;
    }

    Row row() {
        Row atoms;
        while (!token_.empty() && token_ != "}" && token_ != "&" && token_ != "\\\\" && token_ != "\\end") {
            const bool closing = is_bar(token_) ? !open_.empty() && open_.back() == token_
                                                : closes(token_) && std::ranges::any_of(open_, [](auto& c) { return opens(c); });
            if (closing) break;
            atoms.push_back(scripted(atom()));
        }
        return atoms;
    }

    Row group() {
        const auto around = std::exchange(open_, {});
        advance();
        Row inside = row();
        if (token_ != "}") fail("a brace is not closed");
        open_ = around;
        advance();
        return inside;
    }

    /// Returns a group or a single character as one element.
    Atom argument() {
        const Row atoms = token_ == "{" ? group() : Row{atom()};
        return {Kind::ordinary, atoms.size() == 1 ? joined(atoms) : element("mrow", joined(atoms)), is_tall(atoms)};
    }

    std::string script() {
        ++depth_;
        const Atom inside = argument();
        --depth_;
        return inside.xml;
    }

    Atom scripted(Atom base) {
        std::string below, above;
        for (;;) {
            const std::string mark = token_;
            if (const char side = unicode_script(mark)[0]; side != 0) {
                std::string inside = "{";
                for (; unicode_script(token_)[0] == side; advance()) inside += unicode_script(token_).substr(1);
                inside += "}";
                (side == '_' ? below : above) += Writer(inside, name_).script();
                continue;
            }
            if (mark != "_" && mark != "^" && mark != "'") break;
            advance();
            (mark == "_" ? below : above) += mark == "'" ? "<mo>′</mo>" : script();
        }
        if (below.empty() && above.empty()) return base;
        if (is_operator(base.kind)) base = {Kind::ordinary, element("mo", base.xml)};
        static constexpr const char* names[2][3] = {{"msub", "msup", "msubsup"}, {"munder", "mover", "munderover"}};
        const std::string name = names[base.limits][below.empty() ? 1 : above.empty() ? 0 : 2];
        return {base.kind, element(name, base.xml + below + above), base.tall || base.limits, base.limits};
    }

    /// Returns the atoms up to the closing fence of the one that is read.
    Row fenced() {
        open_.push_back(token_);
        advance();
        Row inside = row();
        open_.pop_back();
        return inside;
    }

    Atom fence() {
        const std::string left = token_;
        const Row inside = fenced();
        const auto mo = [&](const std::string& c, const std::string& form) {
            return element("mo", c.substr(c.starts_with('\\')), " form=\"" + form + (is_tall(inside) ? "\"" : "\" stretchy=\"false\""));
        };
        std::string xml = mo(left, "prefix") + joined(inside);
        if (is_bar(left) ? token_ == left : closes(token_)) {
            xml += mo(token_, "postfix");
            advance();
        }
        return {Kind::fence, element("mrow", xml), is_tall(inside)};
    }

    Atom table() {
        if (words() != "aligned") fail("\\begin needs {aligned}, the only known environment");
        std::string rows, cells;
        for (;;) {
            cells += element("mtd", joined(row()));
            const std::string end = token_;
            advance();
            if (end == "&") continue;
            rows += element("mtr", std::exchange(cells, {}));
            if (end == "\\end" && words() == "aligned") return {Kind::ordinary, element("mtable", rows, " displaystyle=\"true\""), true};
            if (end != "\\\\") fail("\\begin{aligned} has no \\end{aligned}");
        }
    }

    /// Returns a letter of another alphabet, as browsers know no mathvariant but "normal".
    std::string styled(const std::string& style) {
        const std::string letter = words();
        if (style == "\\mathrm") return element("mi", xml_escape(letter), letter.size() == 1 ? " mathvariant=\"normal\"" : "");
        if (style == "\\mathcal" && letter == "N") return "<mi>𝒩</mi>";
        if (style == "\\boldsymbol" && letter == "\\varepsilon") return "<mi>𝛆</mi>";
        if (style != "\\mathbf" || letter.size() != 1 || !is_letter(letter[0])) fail("'" + style + "' has no '" + letter + "'");
        const int place = letter[0] < 'a' ? letter[0] - 'A' : letter[0] - 'a' + 26;   // behind U+1D400
        return element("mi", std::string("\xf0\x9d\x90") + static_cast<char>(0x80 + place));
    }

    static Atom accented(const std::string& base, const std::string& accent) {
        return {Kind::ordinary, element("mover", base + element("mo", accent, " stretchy=\"false\""), " accent=\"true\"")};
    }

    /// Returns √μ, or √(…) without its fence.
    Atom root() {
        const bool in_fence = token_ == "(";
        const Row inside = in_fence ? fenced() : token_.empty() ? Row() : Row{argument()};
        if (in_fence) advance();
        return {Kind::ordinary, element("msqrt", joined(inside)), is_tall(inside)};
    }

    Atom command(const std::string& name) {
        if (name == "\\frac" || name == "\\tfrac") {
            const std::string above = argument().xml, fraction = element("mfrac", above + argument().xml);
            return {Kind::ordinary, name == "\\frac" ? fraction : element("mstyle", fraction, " displaystyle=\"false\""), name == "\\frac"};
        }
        if (const auto accent = accents.find(name); accent != accents.end()) return accented(argument().xml, accent->second);
        if (name == "\\begin") return table();
        if (name == "\\text") {
            std::string text = words();
            for (std::size_t at = 0; (at = text.find(' ', at)) != std::string::npos;) text.replace(at, 1, "\u00a0");
            return {Kind::ordinary, element("mtext", xml_escape(text))};
        }
        if (name == "\\operatorname") return {Kind::function, element("mi", xml_escape(words()))};
        if (name.starts_with("\\math") || name == "\\boldsymbol") return {Kind::ordinary, styled(name)};
        if (is_function(std::string_view(name).substr(1)))
            return {Kind::function, element("mi", name.substr(1)), false, name == "\\max" || name == "\\min"};
        if (name.size() != 2 || is_letter(name[1])) fail("'" + name + "' is not known");
        return {Kind::ordinary, element("mi", xml_escape(name.substr(1)), " mathvariant=\"normal\"")};
    }

    Atom atom() {
        if (token_ == "{") return argument();
        if ((opens(token_) || is_bar(token_)) && open_.size() < deepest) return fence();
        const std::string c = token_;
        if (c.empty() || c == "}") fail("a command or a script has no argument");
        advance();
        if (const auto width = spaces.find(c); width != spaces.end()) return {c == "~" ? Kind::blank : Kind::space, space(width->second)};
        if (c == "√" || c == "\\sqrt") return root();
        if (c.starts_with('\\') && !closes(c)) return command(c);
        if (c == "∑" || c == "Σ" || c == "∫") return {Kind::large, element("mo", c == "Σ" ? "∑" : c), false, c != "∫"};
        if (is_digit(c[0]) || c == "½") return {Kind::ordinary, element("mn", c)};
        if (kind_of(c) != Kind::ordinary) return {kind_of(c), c == "-" ? "−" : xml_escape(c)};
        if (c == "ĉ") return accented("<mi>c</mi>", "^");
        if (c.size() > 2 && accents.contains(c.substr(c.size() - 2)))
            return accented(element("mi", c.substr(0, c.size() - 2)), accents.at(c.substr(c.size() - 2)));
        const bool variable = is_letter(c[0]) || is_small_greek(c);
        return {Kind::ordinary, element("mi", xml_escape(c.substr(c.starts_with('\\'))), variable ? "" : " mathvariant=\"normal\"")};
    }

    /// Returns the MathML of atoms, spaced by their neighbours. @param broken  lines may break behind relations
    std::string joined(const Row& atoms, bool broken = false) const {
        std::string xml;
        Kind before = Kind::none;   // the last one that is no space
        for (std::size_t i = 0; i < atoms.size(); ++i) {
            const Atom& atom = atoms[i];
            const Kind left = i == 0 ? Kind::none : atoms[i - 1].kind, right = i + 1 == atoms.size() ? Kind::none : atoms[i + 1].kind;
            xml += written(atom, before, left, right);
            if (broken && atom.kind == Kind::relation && i > 0 && right != Kind::none) xml += "</math><wbr/><math>";
            if (atom.kind != Kind::space && atom.kind != Kind::blank) before = atom.kind;
        }
        return xml;
    }

    std::string written(const Atom& atom, Kind before, Kind left, Kind right) const {
        if (atom.kind == Kind::blank) return is_letter_like(left) && is_letter_like(right) ? atom.xml : "";
        if (is_operator(atom.kind)) {
            const bool binds = atom.kind == Kind::sign && (!is_letter_like(before) || before == Kind::large);
            const std::string tight = !binds && (depth_ > 0 || atom.xml == "/") ? " lspace=\"0\" rspace=\"0\"" : "";
            return element("mo", atom.xml, (binds ? " form=\"prefix\"" : " form=\"infix\"") + tight);
        }
        if (atom.kind != Kind::function) return atom.xml;
        const std::string gap = left != Kind::space && (before == Kind::ordinary || before == Kind::fence) ? space("0.167") : "";
        if (right == Kind::none || is_operator(right)) return gap + atom.xml;
        const bool is_apart = right == Kind::fence || right == Kind::space;
        return gap + atom.xml + element("mo", "\u2061", is_apart ? "" : " rspace=\"0.167em\"");
    }
};

}   // namespace

std::string display_mathml(const std::string& name, std::string_view tex, const std::string& alt) {
    return "<math display=\"block\" alttext=\"" + xml_escape(alt) + "\">" + Writer(tex, name).all() + "</math>";
}

std::string inline_mathml(const std::string& math) {
    const auto length = std::ranges::count_if(math, [](char c) { return (c & '\xc0') != '\x80'; });
    const std::string tex = tex_of(math);
    return "<math>" + Writer(tex, math).all(length > longest_unbroken) + "</math>";
}

}   // namespace meshfolio::report
