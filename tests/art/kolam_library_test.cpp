// The library of kolams, certified: what each file says of itself is what its drawing is.
#include "art/kolam/dot_grid_pattern.h"
#include "art/kolam/kolam.h"
#include "art/kolam/radial_kolam.h"
#include "art/style/style.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

namespace sikku::kolam_library_test {

std::string behind(const std::string& text, const std::string& mark) {
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) return {};
    return text.substr(at + mark.size(), text.find('\n', at) - at - mark.size());
}

KolamExamination examined(const std::string& text) {
    Diagnostics diagnostics;
    const Style style = read_style(parse_pattern("library.lsys", text, diagnostics), 300, diagnostics);
    return examine_kolam(reference::grammar_of(text),
                         {.spline = true, .draws = [&](const Pen& pen) { return style.draws(pen); }});
}

TEST(KolamLibrary, IsCertified) {
    std::set<std::string> codes;
    std::size_t radial = 0;
    for (const std::filesystem::path& file : pattern_files("patterns/kolam-library")) {
        const std::string name = file.stem().string();
        const std::string text = contents(file);
        const KolamExamination found = examined(text);
        const std::string lines = std::to_string(found.lines) + (found.lines == 1 ? " line" : " lines");
        EXPECT_TRUE(has(behind(text, "description: "), lines)) << name;
        EXPECT_EQ(found.open_lines + found.reused_edges, 0u) << name;
        if (name.starts_with("kolam-radial-")) {
            ++radial;
            const RadialKolam kolam = parse_radial_kolam(name.substr(13));
            EXPECT_EQ(found.lines, kolam.lines()) << name;
            EXPECT_EQ(found.symmetry.rotations, kolam.arms) << name;
            EXPECT_TRUE(found.is_kolam()) << name;
            EXPECT_EQ(found.dots.size(), kolam.arms * kolam.dots() + 1) << name;
            continue;
        }
        const DotGrid grid = parse_dot_grid(behind(text, "// grid: "));
        const GapStates states = parse_gap_states(grid, behind(text, "// gaps: "));
        const std::string code = kolam_code(grid, states);
        EXPECT_TRUE(codes.insert(code).second) << name << " is an image of another one";
        EXPECT_TRUE(name.ends_with(code)) << name;
        const bool is_rounded = grid.lattice() == DotLattice::triangular || has(text, " --rim ");
        EXPECT_EQ(found.is_exact, !is_rounded) << name;
        EXPECT_EQ(found.lines, laplacian_nullity(grid, states)) << name;
        EXPECT_EQ(found.crossings, std::count(states.begin(), states.end(), GapState::crossed)) << name;
        // Around a hole no single line has a symmetry: see single_line_obstacle().
        if (!name.starts_with("kolam-ring-")) {
            EXPECT_GT(found.symmetry.rotations + found.symmetry.mirrors, 1u) << name;
        }
        if (std::find(states.begin(), states.end(), GapState::joined) == states.end()) {
            EXPECT_TRUE(found.is_kolam()) << name;
            EXPECT_EQ(found.dots.size(), grid.dots().size()) << name;
        }
    }
    EXPECT_EQ(codes.size() + radial, 100u);
}

}  // namespace sikku::kolam_library_test
