// tests/art/recipe_test.cpp: patterns can be read back from the comments of plots, models and GIF files.
#include "art/print/recipe_comments.h"
#include "art/prints.h"
#include "art/provenance/provenance.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/files.h"

#include <gtest/gtest.h>

namespace sikku::recipe_test {

TEST(Recipe, AnyTextComesBack) {
    std::string all;
    for (int byte = 1; byte < 256; ++byte) all += static_cast<char>(byte);
    for (const std::string& pattern : {std::string("x"), std::string("axiom: F\n"), all, std::string(5000, '~')}) {
        std::string text = "before\n";
        for (const std::string& piece : recipe_comments(pattern, "sikku 1, -n 2")) {
            EXPECT_LE(piece.size(), 60U);
            EXPECT_EQ(piece.find_first_of("!?~%();\"\\\n"), std::string::npos) << piece;
            text += "# " + piece + "\n";
        }
        const auto found = read_recipe_comments(text + "after");
        ASSERT_TRUE(found) << pattern;
        EXPECT_EQ(found->first, pattern);
        EXPECT_EQ(found->second, "sikku 1, -n 2");
    }
    EXPECT_TRUE(recipe_comments(std::string(most_commented_bytes, 'x'), "").empty());
}

TEST(Recipe, DamagedCommentsAreNoRecipe) {
    EXPECT_FALSE(read_recipe_comments(""));
    EXPECT_FALSE(read_recipe_comments("sikku:"));
    EXPECT_FALSE(read_recipe_comments("sikku:AAAA"));
    const auto pieces = recipe_comments(std::string(100, 'x'), "made");
    EXPECT_FALSE(read_recipe_comments(pieces.front())) << "the end is missing";
    EXPECT_FALSE(read_recipe_comments(pieces.back())) << "the beginning is missing";
}

TEST(Recipe, PlotsModelsAndAnimationsGiveTheirPatternBack) {
    const ScratchFolder folder;
    const Document bush = load("bush-3d", {"", {{"test", "derivation length", "2"}}});
    for (const char* format : {"gcode", "hpgl", "obj", "glb"}) {
        const std::string file = folder.file(std::string("bush.") + format);
        prints().plan(bush, format, {})->make(file_system(), file, {});
        const auto shown = read_provenance(file);
        ASSERT_TRUE(shown) << format;
        EXPECT_TRUE(shown->pattern == bush.source().text()) << format;
        EXPECT_TRUE(has(shown->made, "-n 2"));
    }
    const Document dragon = load("dragon");
    const std::string gif = folder.file("growth.gif");
    prints()
        .plan(dragon, "gif", {{"generations", "1:3"}, {"size", "20x20mm"}, {"margin", "1mm"}, {"dpi", "60"}})
        ->make(file_system(), gif, {});
    const auto found = read_provenance(gif);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->pattern == dragon.source().text());
    EXPECT_FALSE(read_provenance(folder.write("bush.mtl", "newmtl a\n")));
}

}  // namespace sikku::recipe_test
