// art/sheet/sheet_cells.h: the drawings of a sheet one by one: their options, their prints, their errors.
#pragma once

#include "art/drawing/word_drawing.h"
#include "art/sheet/sheet.h"
#include "art/writer/draw_options.h"
#include "engine/derivation/derivation.h"

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>
#include <typeinfo>

namespace sikku {

/// Rethrows errors of a drawing with the name of its cell; exceptions of the caller pass unchanged.
template <class Work>
auto named_cell(const SheetCell& cell, Work&& work) {
    const auto told = [&](const std::exception& error) { return fmt::format("'{}': {}", cell.title, error.what()); };
    try {
        return work();
    } catch (const BudgetError& error) {
        throw BudgetError(told(error));
    } catch (const WordError& error) {
        throw WordError(told(error));
    } catch (const NothingDrawn& error) {
        throw std::runtime_error(told(error));
    } catch (const std::runtime_error& error) {
        if (typeid(error) != typeid(std::runtime_error)) throw;
        throw std::runtime_error(told(error));
    }
}

DrawOptions cell_options(const SheetCell& cell, const SheetOptions& options);

/// A print about as large as a cell among `count` will be.
Print cell_print(const SheetCell& cell, const SheetOptions& options, std::size_t count);

}  // namespace sikku
