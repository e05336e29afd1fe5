/// @file
/// A table is its columns: each has its head and what its cells hold in one place.
///
///     add(section, table("q3_orders", words.line("orders"), refinements)
///                      .column("surface", [](auto& r) { return r.surface.name; })
///                      .column("smallest angle", {.unit = "°"}, [](auto& r) { return degrees(r.smallest_angle); }));
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "report/document.h"

namespace meshfolio {

using Best = report::Column::Best;
using Rounding = report::Column::Rounding;
using Heat = report::Column::Heat;

namespace detail {
inline report::Cell cell(report::Cell cell) { return cell; }
inline report::Cell cell(std::string words) { return words; }
inline report::Cell cell(std::string_view words) { return std::string(words); }
inline report::Cell cell(const char* words) { return std::string(words); }
template <class Number>
requires std::is_arithmetic_v<Number> report::Cell cell(Number x) { return static_cast<double>(x); }
}   // namespace detail

/// A table under construction: a row for each element of a range.
template <class Rows> class TableBuilder {
public:
    TableBuilder(std::string id, std::string caption, Rows rows) : rows_(std::forward<Rows>(rows)) {
        table_.id = std::move(id);
        table_.caption = std::move(caption);
        table_.rows.resize(std::size(rows_));
    }

    /// Adds a column with a cell for each element. @param look  unit, digits, …; its name becomes `name`
    /// @param cell_of  from an element to a number, a text or a report::Cell
    template <class CellOf> TableBuilder& column(std::string name, report::Column look, const CellOf& cell_of) {
        look.name = std::move(name);
        table_.columns.push_back(std::move(look));
        auto row = table_.rows.begin();
        for (const auto& element : rows_) (row++)->push_back(detail::cell(std::invoke(cell_of, element)));
        return *this;
    }
    template <class CellOf> TableBuilder& column(std::string name, const CellOf& cell_of) {
        return column(std::move(name), report::Column{}, cell_of);
    }

    /// Lets readers of the page sort the rows.
    TableBuilder& sortable() {
        table_.sortable = true;
        return *this;
    }

    /// Marks the table as one for programs: it goes into a file and no page shows it, so no text may refer to it.
    TableBuilder& file_only() {
        table_.file_only = true;
        return *this;
    }

    operator report::Table() const { return table_; }

private:
    Rows rows_;   // a reference, or a range of its own
    report::Table table_;
};

/// Begins a table with a row for each element of `rows`, and no columns yet.
template <class Rows> TableBuilder<Rows> table(std::string id, std::string caption, Rows&& rows) {
    return {std::move(id), std::move(caption), std::forward<Rows>(rows)};
}

/// An element of a list within a list: rows of a table that has one for each level of each refinement, say.
template <class Whole, class Part> struct Within {
    const Whole& whole;
    const Part& part;
};

/// Returns every part of every whole, in order, each with its whole. @param parts_of  from a whole to a range that it holds
template <class Wholes, class PartsOf> auto parts_within(const Wholes& wholes, const PartsOf& parts_of) {
    using Whole = std::remove_cvref_t<decltype(*std::begin(wholes))>;
    using Part = std::remove_cvref_t<decltype(*std::begin(std::invoke(parts_of, std::declval<const Whole&>())))>;
    std::vector<Within<Whole, Part>> parts;
    for (const Whole& whole : wholes)
        for (const Part& part : std::invoke(parts_of, whole)) parts.push_back({whole, part});
    return parts;
}

}   // namespace meshfolio
