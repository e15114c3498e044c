// tests/fuzz/reading_targets.h: fuzz target that reads arbitrary text as a kolam: JSON, a table, gestures, an SVG.
#pragma once

#include "art/reading/gesture_drawing.h"
#include "art/reading/gestures.h"
#include "art/reading/kolam_csv.h"
#include "art/reading/kolam_json.h"
#include "art/reading/kolam_svg.h"
#include "art/reading/polygon_files.h"
#include "engine/tiling/tiling.h"
#include "tests/fuzz/file_targets.h"

#include <stdexcept>
#include <string>
#include <string_view>

namespace sikku {

/// What is read has a state for each gap, and comes back where the format can hold it.
inline void try_reading(std::string_view text) {
    const std::string copy(text);
    const auto attempt = [](auto&& work) {
        try {
            work();
        } catch (const std::runtime_error& error) {
            must_be_plain(error.what(), "an error");
        }
    };
    const auto check = [](const ReadKolam& kolam) {
        must(kolam.states.size() == kolam.grid.gaps().size(), "a gap has no state");
        must(kolam.certainty.empty() || kolam.certainty.size() == kolam.states.size(), "a gap has no certainty");
        must_be_plain(kolam.title, "a title");
        for (const std::string& note : kolam.notes) must_be_plain(note, "a note");
    };
    attempt([&] {
        const ReadKolam kolam = read_kolam_json(copy);
        check(kolam);
        must(read_kolam_json(kolam_json_file(kolam.grid, kolam.states)).states == kolam.states,
             "a kolam does not come back from JSON");
    });
    attempt([&] { check(read_kolam_csv(copy, 1)); });
    attempt([&] {
        const ReadKolam kolam = read_gestures(copy);
        check(kolam);
        if (!kolam.doubtful().empty() || kolam.grid.dots().size() > 1000) return;
        for (const GapState state : kolam.states) {
            if (state == GapState::joined) return;
        }
        must(read_gestures(gestures_file(kolam.grid, kolam.states)).states == kolam.states,
             "a kolam does not come back from gestures");
    });
    attempt([&] {
        const GestureDrawing drawing = draw_gestures(copy);
        must(!drawing.lines.empty() && !drawing.dots.empty(), "gestures draw nothing");
    });
    attempt([&] { check(read_kolam_svg(copy)); });
    const auto tiles = [](const PolygonList& list) {
        must(list.begin.back() == list.corners.size(), "a polygon is not complete");
        if (list.corners.size() > 2000 || list.size() == 0) return;
        const TilingExamination t = examine_polygons(list, usual_tolerance(list), {}).examination;
        must(t.tiles <= list.size(), "there are more tiles than polygons");
    };
    attempt([&] { tiles(read_polygons_json(copy)); });
    attempt([&] { tiles(read_polygons_svg(copy)); });
}

}  // namespace sikku
