#include "art/reading/kolam_json.h"

#include "art/reading/kolam_lines.h"
#include "engine/base/diagnostic.h"
#include "engine/base/json.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace sikku {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_json(const std::string& what) {
    throw std::runtime_error("not a valid .kolam.json file: " + what);
}

const Json& member(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key)) refuse_json(fmt::format("'{}' is missing", key));
    return object.at(key);
}

std::size_t whole(const Json& design, const char* key) {
    const Json& value = member(design, key);
    if (!value.is_number_integer() || value.get<std::int64_t>() < 1 ||
        value.get<std::int64_t>() > static_cast<std::int64_t>(DotGrid::most_dots)) {
        refuse_json(fmt::format("'{}' is not a whole number from 1 to {}", key, DotGrid::most_dots));
    }
    return static_cast<std::size_t>(value.get<std::int64_t>());
}

/// Texts of one length, with letters of a set.
std::vector<std::string> texts(const Json& design, const char* key, std::size_t count, std::size_t length,
                               std::string_view letters) {
    const Json& value = member(design, key);
    if (!value.is_array() || value.size() != count) {
        refuse_json(fmt::format("'{}' is not a list of {} texts", key, count));
    }
    std::vector<std::string> rows;
    for (std::size_t r = 0; r < count; ++r) {
        if (!value[r].is_string()) refuse_json(fmt::format("'{}', row {}: not a text", key, r + 1));
        rows.push_back(value[r].get<std::string>());
        if (rows.back().size() != length) {
            refuse_json(
                fmt::format("'{}', row {}: {} letters instead of {}", key, r + 1, rows.back().size(), length));
        }
        const std::size_t wrong = rows.back().find_first_not_of(letters);
        if (wrong != std::string::npos) {
            refuse_json(fmt::format("'{}', row {}, letter {}: '{}'; expected one of '{}'", key, r + 1, wrong + 1,
                                    printable(rows.back().substr(wrong, 1)), letters));
        }
    }
    return rows;
}

}  // namespace

ReadKolam read_kolam_json(const std::string& text, std::size_t number) {
    Json whole_file;
    try {
        whole_file = read_json(text);
    } catch (const JsonError& error) {
        refuse_json(fmt::format("byte {}: {}", error.byte, error.what()));
    }
    const bool is_list = whole_file.is_array();
    if (!is_list && !whole_file.is_object()) refuse_json("neither an object nor a list");
    const std::size_t count = is_list ? whole_file.size() : 1;
    if (count == 0) refuse_json("the list is empty");
    if (number < 1 || number > count) {
        throw std::runtime_error(fmt::format("no kolam {}; the file contains {}", number, counted(count, "kolam")));
    }
    const Json& file = is_list ? whole_file[number - 1] : whole_file;
    if (!file.is_object()) refuse_json(fmt::format("kolam {} of the list is not an object", number));
    const Json& format = member(file, "format");
    if (!format.is_string() || format.get<std::string>() != "kolam") refuse_json("'format' is not \"kolam\"");
    const Json& version = member(file, "version");
    if (!version.is_number_integer() || version.get<std::int64_t>() != 1) {
        refuse_json("'version' is not 1, the only supported version");
    }
    const Json& design = member(file, "design");
    const std::size_t rows = whole(design, "rows");
    const std::size_t columns = whole(design, "cols");
    if (rows * columns > DotGrid::most_dots) refuse_json(fmt::format("more than {} dots", DotGrid::most_dots));
    const auto mask = texts(design, "mask", rows, columns, "01");
    const auto within = texts(design, "h", rows, columns - 1, "xpj.");
    const auto below = texts(design, "v", rows - 1, columns, "xpj.");

    std::vector<GridDot> places;
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            if (mask[r][c] == '1')
                places.push_back({2 * static_cast<std::int32_t>(c), -2 * static_cast<std::int32_t>(r)});
        }
    }
    if (places.empty()) refuse_json("the mask has no dots");
    const PlacedGrid placed = place_grid(DotLattice::square, std::move(places));
    ReadKolam kolam{placed.grid, {}, {}, {}, {}, {}};
    std::size_t used = 0;
    for (const GridGap& gap : placed.grid.gaps()) {
        const GridDot dot = placed.grid.dots()[gap.from];
        const auto r = static_cast<std::size_t>(-(dot.y + placed.origin.y) / 2);
        const auto c = static_cast<std::size_t>((dot.x + placed.origin.x) / 2);
        const bool is_within = gap.side == 0;
        const auto state = state_of_letter(is_within ? within[r][c] : below[r][c]);
        if (!state) {
            refuse_json(
                fmt::format("'{}', row {}, letter {}: '.' between two dots", is_within ? "h" : "v", r + 1, c + 1));
        }
        kolam.states.push_back(*state);
        ++used;
    }
    std::size_t given = 0;
    for (const auto* list : {&within, &below}) {
        for (const std::string& row : *list) {
            for (const char letter : row) given += letter != '.';
        }
    }
    if (given != used) refuse_json(fmt::format("{} gaps have a state, but {} lie between two dots", given, used));
    if (file.contains("title") && file["title"].is_string()) {
        kolam.title = printable(file["title"].get<std::string>(), 200);
    }
    if (count > 1) kolam.notes.push_back(fmt::format("kolam {} of {} in the list", number, count));
    return kolam;
}

std::string kolam_json_file(const DotGrid& grid, const GapStates& states) {
    if (grid.lattice() != DotLattice::square) {
        throw std::runtime_error(".kolam.json can contain only straight grids; this one is interlaced");
    }
    PlaceBox box;
    for (const GridDot dot : grid.dots()) box.add(dot);
    const auto rows = static_cast<std::size_t>((box.high.y - box.low.y) / 2 + 1);
    const auto columns = static_cast<std::size_t>((box.high.x - box.low.x) / 2 + 1);
    if (rows * columns > 4 * DotGrid::most_dots)
        throw std::runtime_error("the dots lie too far apart for .kolam.json");
    std::vector<std::string> mask(rows, std::string(columns, '0'));
    std::vector<std::string> within(rows, std::string(columns - 1, '.'));
    std::vector<std::string> below(rows - 1, std::string(columns, '.'));
    const auto row = [&](GridDot dot) { return static_cast<std::size_t>((box.high.y - dot.y) / 2); };
    const auto column = [&](GridDot dot) { return static_cast<std::size_t>((dot.x - box.low.x) / 2); };
    for (const GridDot dot : grid.dots()) mask[row(dot)][column(dot)] = '1';
    for (std::size_t i = 0; i < states.size(); ++i) {
        const GridGap& gap = grid.gaps()[i];
        const GridDot dot = grid.dots()[gap.from];
        (gap.side == 0 ? within : below)[row(dot)][column(dot)] =
            gap_state_names[static_cast<std::size_t>(states[i])].letter;
    }
    const Json design = {{"rows", rows}, {"cols", columns}, {"mask", mask}, {"h", within}, {"v", below}};
    return Json{{"format", "kolam"}, {"version", 1}, {"design", design}}.dump(2) + "\n";
}

}  // namespace sikku
