// studio/bridge_photograph.cpp: reads the kolam of a photograph, whose pixels the page has decoded.
#include "art/decoder/averager.h"
#include "art/reading/kolam_report.h"
#include "art/reading/straightened.h"
#include "studio/bridge_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sikku {
namespace {

constexpr int most_photograph_side = 8000;  // of a picture
constexpr int most_straight_side = 1100;
constexpr double photograph_margin = 2;  // of the straightened picture around the dots, in spacings

int side_of(const Json& request, const std::string& name) {
    const double side = number_of(request, name, 0);
    if (!(side >= 1 && side <= most_photograph_side)) {
        throw BadRequest(fmt::format("{}: expected 1 to {} pixels", name, most_photograph_side));
    }
    return static_cast<int>(side);
}

/// Averages RGBA pixels as the program averages those of a file.
PictureDecoder decoder_of(const Json& request, const std::string& file) {
    const int width = side_of(request, "width"), height = side_of(request, "height");
    const std::size_t row_bytes = 4 * static_cast<std::size_t>(width);
    if (file.size() != row_bytes * static_cast<std::size_t>(height)) {
        throw BadRequest(fmt::format("{} bytes; expected {} x {} pixels of 4 bytes", file.size(), width, height));
    }
    return [=, &file](int longest_side) {
        Averager averager(width, height, {.channels = 4, .alpha = 3, .is_colour_times_alpha = false}, longest_side);
        const auto* rows = reinterpret_cast<const std::uint8_t*>(file.data());
        for (int y = 0; y < height; ++y) averager.row(rows + row_bytes * static_cast<std::size_t>(y));
        return averager.take(1);
    };
}

PhotographOptions photograph_options(const Json& request) {
    PhotographOptions options;
    if (request.contains("part")) options.number = static_cast<std::size_t>(whole_of(request["part"], "part"));
    if (request.contains("grid")) options.grid = parse_dot_grid(text_of(request, "grid"));
    for (const Json& fix : request.value("fixes", Json::array())) {
        if (!fix.is_string()) throw BadRequest("fixes: expected texts");
        options.fixes.push_back(fix.get<std::string>());
    }
    return options;
}

Json places_json(const std::vector<GridDot>& places) {
    Json all = Json::array();
    for (const GridDot& place : places) all.push_back({place.x, place.y});
    return all;
}

/// The box of the dots and the margin around it, in spacings from its middle.
Box shown_box(const DotGrid& grid) {
    std::vector<glm::dvec2> places;
    for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) places.push_back(dot_place(grid, dot));
    const auto [low, high] = box_of(places);
    return {low - photograph_margin, high + photograph_margin};
}

}  // namespace

Json answer_read(const Json& request, const std::string& file, const Monitor& monitor, std::string& bytes) {
    const Photograph photograph = read_photograph(decoder_of(request, file), photograph_options(request), monitor);
    const ReadKolam& kolam = photograph.kolam;
    const KolamReport report = report_kolam(kolam, monitor);
    const Box box = shown_box(kolam.grid);
    const StraightPicture picture = straightened(photograph, box, most_straight_side);
    bytes.assign(picture.pixels.begin(), picture.pixels.end());
    return {{"text", read_kolam_pattern(kolam, report, text_of(request, "source", "a photograph"), monitor)},
            {"summary", kolam_summary(kolam, report)},
            {"grid", kolam.grid.text()},
            {"gaps", gap_states_text(kolam.grid, kolam.states)},
            {"doubtful", kolam.doubtful()},
            {"repaired", kolam.repaired},
            {"notes", kolam.notes},
            {"open_ends", places_json(photograph.open_ends)},
            {"missing", places_json(photograph.missing)},
            {"readable", photograph.readable},
            {"picture",
             {{"width", picture.width},
              {"height", picture.height},
              // In half spacings, y up.
              {"box", {2 * box.low.x, 2 * box.low.y, 2 * box.high.x, 2 * box.high.y}}}}};
}

}  // namespace sikku
