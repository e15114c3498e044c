// tests/art/font_test.cpp: texts in the outlines of fonts: glyphs as hb-shape chooses them, outlines as FreeType
// reads them, damaged fonts.
#include "art/font/font.h"

#include "art/font/letters.h"
#include "art/prints.h"
#include "engine/base/output.h"
#include "engine/base/text.h"
#include "engine/geometry/box.h"
#include "engine/geometry/contours.h"
#include "engine/geometry/recorded_path.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace sikku::font_test {

const std::string lohit = "/usr/share/fonts/truetype/lohit-tamil/Lohit-Tamil.ttf";
const std::string noto = "/usr/share/fonts/truetype/noto/";

#define REQUIRE_FONTS()                                                                           \
    if (!std::filesystem::exists(lohit) || !std::filesystem::exists(noto + "NotoSerif-Bold.ttf")) \
    GTEST_SKIP() << "fonts-lohit-taml or fonts-noto-core is not installed"

/// Texts that need shaping: Tamil with vowels on both sides, Devanagari with conjuncts, Arabic and Hebrew from right
/// to left, combining accents and ligatures.
const std::vector<std::pair<std::string, std::u32string>> shaped_texts = {
    {lohit, U"மீரா கோலம்"},
    {lohit, U"ஸ்ரீ"},
    {lohit, U"பௌர்ணமி, க்ஷ"},
    {noto + "NotoSerifTamil-Regular.ttf", U"ஸ்ரீ மீரா கோலம்"},
    {noto + "NotoSansDevanagari-Regular.ttf", U"रंगोली, श्री, क्षत्रिय, हिन्दी"},
    {noto + "NotoNaskhArabic-Regular.ttf", U"السلام عليكم"},
    {noto + "NotoSansHebrew-Regular.ttf", U"שָׁלוֹם"},
    {noto + "NotoSerif-Regular.ttf", U"Kolam e\u0301e\u0323 office AVATAR"}};

std::string utf8(std::u32string_view text) {
    std::string bytes;
    for (const char32_t code : text) append_utf8(code, bytes);
    return bytes;
}

TEST(Font, GlyphsArePlacedAsByHbShape) {
    REQUIRE_FONTS();
    NEEDS("hb-shape");
    for (const auto& [file, text] : shaped_texts) {
        const ToolOutcome tool = run_tool("hb-shape --output-format=json --no-glyph-names --language=und '" + file +
                                          "' '" + utf8(text) + "'");
        const auto expected = nlohmann::json::parse(tool.text);
        const auto font = open_font(file, "");
        const ShapedText shaped = font->shape(text);
        ASSERT_EQ(shaped.glyphs.size(), expected.size()) << utf8(text);
        FT_Library library = nullptr;
        FT_Face face = nullptr;
        ASSERT_EQ(FT_Init_FreeType(&library), 0);
        ASSERT_EQ(FT_New_Face(library, file.c_str(), 0, &face), 0);
        const double unit = 1.0 / face->units_per_EM;
        double end = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(shaped.glyphs[i].glyph, expected[i]["g"].get<unsigned>()) << utf8(text) << " " << i;
            EXPECT_NEAR(shaped.glyphs[i].at.x, (end + expected[i]["dx"].get<double>()) * unit, 1e-9) << utf8(text);
            EXPECT_NEAR(shaped.glyphs[i].at.y, expected[i]["dy"].get<double>() * unit, 1e-9) << utf8(text);
            EXPECT_EQ(shaped.glyphs[i].cluster, expected[i]["cl"].get<std::size_t>()) << utf8(text);
            end += expected[i]["ax"].get<double>();
        }
        EXPECT_NEAR(shaped.width, end * unit, 1e-9) << utf8(text);
        FT_Done_FreeType(library);
    }
}

/// Area of closed contours by the formula of Green, with eight chords for each curve, and their box.
struct Measures {
    double area = 0;
    Box box;
    std::size_t contours = 0;

    void add(const GlyphContour& contour) {
        ++contours;
        for (std::size_t i = 0; i + 3 < contour.size(); i += 3) {
            glm::dvec2 from = contour[i];
            for (int k = 1; k <= 8; ++k) {
                const double t = k / 8.0, s = 1 - t;
                const glm::dvec2 to = s * s * s * contour[i] + 3 * s * s * t * contour[i + 1] +
                                      3 * s * t * t * contour[i + 2] + t * t * t * contour[i + 3];
                area += (from.x * to.y - from.y * to.x) / 2;
                box.add(to);
                from = to;
            }
        }
    }
};

/// An outline as FreeType decomposes it, without hints and scale.
Measures measured_by_freetype(FT_Face face, unsigned glyph) {
    std::vector<GlyphContour> contours;
    const FT_Outline_Funcs functions = {
        [](const FT_Vector* to, void* data) {
            static_cast<std::vector<GlyphContour>*>(data)->push_back({glm::dvec2(to->x, to->y)});
            return 0;
        },
        [](const FT_Vector* to, void* data) {
            GlyphContour& contour = static_cast<std::vector<GlyphContour>*>(data)->back();
            const glm::dvec2 from = contour.back(), end(to->x, to->y);
            contour.insert(contour.end(), {from + (end - from) / 3.0, end - (end - from) / 3.0, end});
            return 0;
        },
        [](const FT_Vector* control, const FT_Vector* to, void* data) {
            GlyphContour& contour = static_cast<std::vector<GlyphContour>*>(data)->back();
            const glm::dvec2 from = contour.back(), middle(control->x, control->y), end(to->x, to->y);
            contour.insert(contour.end(), {(from + 2.0 * middle) / 3.0, (end + 2.0 * middle) / 3.0, end});
            return 0;
        },
        [](const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* data) {
            GlyphContour& contour = static_cast<std::vector<GlyphContour>*>(data)->back();
            contour.insert(contour.end(), {glm::dvec2(first->x, first->y), glm::dvec2(second->x, second->y),
                                           glm::dvec2(to->x, to->y)});
            return 0;
        },
        0,
        0};
    EXPECT_EQ(FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE), 0);
    EXPECT_EQ(FT_Outline_Decompose(&face->glyph->outline, &functions, &contours), 0);
    Measures measures;
    for (GlyphContour& contour : contours) {
        for (glm::dvec2& point : contour) point /= face->units_per_EM;
        measures.add(contour);
    }
    return measures;
}

TEST(Font, OutlinesAreThoseOfFreeType) {
    REQUIRE_FONTS();
    for (const std::string& file :
         {lohit, noto + "NotoSerifTamil-Regular.ttf", noto + "NotoSansDevanagari-Regular.ttf"}) {
        const auto font = open_font(file, "");
        FT_Library library = nullptr;
        FT_Face face = nullptr;
        ASSERT_EQ(FT_Init_FreeType(&library), 0);
        ASSERT_EQ(FT_New_Face(library, file.c_str(), 0, &face), 0);
        std::size_t drawn = 0;
        for (unsigned glyph = 0; glyph < static_cast<unsigned>(face->num_glyphs); ++glyph) {
            Measures measures;
            for (const GlyphContour& contour : font->outline(glyph)) {
                EXPECT_EQ(contour.size() % 3, 1u);
                EXPECT_EQ(contour.front(), contour.back());
                measures.add(contour);
            }
            const Measures expected = measured_by_freetype(face, glyph);
            EXPECT_EQ(measures.contours, expected.contours) << file << " " << glyph;
            // FreeType rounds implied points to whole units.
            EXPECT_NEAR(measures.area, expected.area, 5e-4) << file << " " << glyph;
            if (measures.contours == 0) continue;
            EXPECT_NEAR(measures.box.low.x, expected.box.low.x, 2e-3) << file << " " << glyph;
            EXPECT_NEAR(measures.box.high.y, expected.box.high.y, 2e-3) << file << " " << glyph;
            ++drawn;
        }
        EXPECT_GT(drawn, 100u);
        FT_Done_FreeType(library);
    }
}

TEST(Font, TextsOfBothDirectionsFollowUnicode) {
    REQUIRE_FONTS();
    const auto font = open_font(noto + "NotoSansHebrew-Regular.ttf", "");
    // Figures keep their order in text from right to left; clusters are places in the text.
    const auto order = [&](std::u32string_view text) {
        std::vector<std::size_t> clusters;
        for (const ShapedGlyph& glyph : font->shape(text).glyphs) clusters.push_back(glyph.cluster);
        return clusters;
    };
    EXPECT_EQ(order(U"אב 12"), (std::vector<std::size_t>{3, 4, 2, 1, 0}));
    EXPECT_EQ(order(U"12 אב 3"), (std::vector<std::size_t>{6, 5, 4, 3, 2, 0, 1}));
    EXPECT_EQ(order(U"a אב c"), (std::vector<std::size_t>{0, 1, 3, 2, 4, 5}));
    EXPECT_EQ(order(U"(אב)"), (std::vector<std::size_t>{3, 2, 1, 0}));
}

std::string refusal(const std::string& name) {
    try {
        open_font(name, "");
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

TEST(Font, SubstitutesAreRefused) {
    REQUIRE_FONTS();
    EXPECT_EQ(open_font("Lohit Tamil", "")->name(), "Lohit Tamil Regular");
    EXPECT_EQ(open_font("noto  serif:bold", "")->name(), "Noto Serif Bold");
    EXPECT_EQ(open_font("Noto Serif:style=Italic", "")->name(), "Noto Serif Italic");
    EXPECT_TRUE(refusal("Nonesuch").starts_with("no font named 'Nonesuch' is installed; the nearest is '"));
    EXPECT_TRUE(refusal("Lohit Tamil:bold").ends_with("the nearest is 'Lohit Tamil Regular'"));
    EXPECT_TRUE(refusal("serif").starts_with("no font named 'serif' is installed"));
    for (const char* name : {"", ":bold", "Nonesuch:x=", ":::"}) EXPECT_NE(refusal(name), "") << name;
    EXPECT_NE(refusal("/nonesuch.ttf"), "");
}

TEST(Font, PartsOfNamesThatFontconfigIgnoresAreRefused) {
    REQUIRE_FONTS();
    for (const char* name : {"Noto Serif:weight=200", "Noto Serif:weight=bold", "Noto Serif: bold:roman"}) {
        EXPECT_EQ(open_font(name, "")->name(), "Noto Serif Bold") << name;
    }
    EXPECT_TRUE(refusal("Noto Serif-Bold").starts_with("a size follows '-'"));
    EXPECT_TRUE(refusal("Noto Serif-12").starts_with("a size follows '-'"));
    for (const char* part :
         {"wieght=200", "bolld", "fontvariations=wght=700", "index=5", "spacing=mono", "mono", "nonsense=3",
          "size=12", "weight=", "weight=bolld", "slant=itallic", "weight=[80 200]"}) {
        EXPECT_TRUE(refusal(std::string("Noto Serif:") + part).starts_with("unknown property or value")) << part;
    }
    for (const char* name : {"Nonesuch,Noto Serif", "Noto Serif:bold:light", "Noto Serif:style=Bold,Italic"}) {
        EXPECT_TRUE(refusal(name).starts_with("the name of a font states several")) << name;
    }
    EXPECT_TRUE(refusal("None\\-such").starts_with("no font named"));
}

TEST(Letters, ShortenedTextsFitAndKeepClusters) {
    REQUIRE_FONTS();
    const Letters letters(open_font("Noto Serif Tamil", ""));
    const std::string text = "மீரா கோலம் ஸ்ரீ மீரா கோலம்";
    const double width = letters.width(text, 2);
    EXPECT_EQ(letters.shortened(text, 2, width), text);
    for (const double part : {0.2, 0.4, 0.6, 0.9}) {
        const std::string less = letters.shortened(text, 2, part * width);
        EXPECT_LE(letters.width(less, 2), part * width * (1 + 1e-9));
        EXPECT_LT(less.size(), text.size());
    }
    // A vowel stays with its consonant: each of the four syllables is whole or missing.
    const std::string syllables = "கோகோகோகோ";
    for (double part = 0.05; part < 1; part += 0.05) {
        const std::string less = letters.shortened(syllables, 2, part * letters.width(syllables, 2));
        const std::size_t kept = std::min(less.find("…"), less.find("..."));
        EXPECT_EQ(std::min(kept, less.size()) % (syllables.size() / 4), 0u) << less;
    }
    EXPECT_EQ(letters.shortened(text, 2, 0), "");
}

TEST(Letters, MissingCharactersAreNamed) {
    REQUIRE_FONTS();
    const Letters letters(open_font("Lohit Tamil", ""));
    EXPECT_EQ(letters.missing({"மீரா கோலம்", "3/50"}), "");
    EXPECT_TRUE(
        letters.missing({"日本 日"}).starts_with("the font 'Lohit Tamil Regular' lacks 日 (U+65E5), 本 (U+672C);"));
    EXPECT_TRUE(letters.missing({"\xff"}).find("the byte 0xff") != std::string::npos);
}

TEST(Letters, LongTextsEnd) {
    REQUIRE_FONTS();
    const Letters letters(open_font("Noto Serif", ""));
    const std::string longest(most_font_letters, 'k');
    EXPECT_LE(letters.width(letters.shortened(longest, 3, 100), 3), 100);
    EXPECT_EQ(letters.shortened(longest, 3, 1e9), longest);
    EXPECT_EQ(letters.width(longest + "k", 3), letters.width(longest, 3));
    EXPECT_EQ(letters.shortened(longest + "k", 3, 1e9), longest.substr(1) + "…");
}

TEST(Letters, ContoursOfALetterAreOneAreaWithBridges) {
    REQUIRE_FONTS();
    const Letters letters(open_font("Noto Serif", ""));
    RecordedPath path;
    letters.write("B", {5, 5}, 10, {}, path);
    struct Seen : PolygonSink {
        std::size_t areas = 0, contours = 0, curves = 0;
        void polygon(std::span<const glm::dvec2>, const Pen&) override {}
        void area(std::span<const glm::dvec2> outline, const Pen&) override {
            ++areas;
            each_contour(
                outline, [&](glm::dvec2) { ++contours; }, [&](std::span<const glm::dvec2>) { ++curves; });
            EXPECT_EQ(outline.front(), outline.back());
        }
    } seen;
    path.draw(seen);
    EXPECT_EQ(seen.areas, 1u);
    EXPECT_EQ(seen.contours, 3u);
    EXPECT_GT(seen.curves, 20u);
}

/// Draws a text and returns whether that worked.
bool survives(const std::string& bytes, const ScratchFolder& folder) {
    const auto file = folder / "damaged.ttf";
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    try {
        const Letters letters(open_font(file.string(), ""));
        RecordedPath path;
        letters.write("மீரா கோலம் ஸ்ரீ 3/50", {0, 0}, 10, {}, path);
        letters.missing({"மீரா கோலம் ஸ்ரீ 3/50"});
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

TEST(FontStress, DamagedFontsAreRefusedOrDrawn) {
    REQUIRE_FONTS();
    const ScratchFolder folder;
    const std::string whole = contents(lohit);
    ASSERT_TRUE(survives(whole, folder));
    std::mt19937 random(35);
    std::size_t refused = 0;
    for (int i = 0; i < 60; ++i) refused += !survives(whole.substr(0, random() % whole.size()), folder);
    EXPECT_EQ(refused, 60u);
    for (int i = 0; i < 200; ++i) {
        std::string bytes = whole;
        // Half of the changes hit the directory and the headers of tables.
        const std::size_t range = i % 2 == 0 ? 4000 : bytes.size();
        const int changes = 1 + static_cast<int>(random() % 40);
        for (int k = 0; k < changes; ++k) bytes[random() % range] = static_cast<char>(random());
        survives(bytes, folder);
    }
    for (const std::string& nothing :
         {std::string(), std::string("a"), std::string(5000, '\0'), std::string("OTTO")}) {
        EXPECT_FALSE(survives(nothing, folder));
    }
}

}  // namespace sikku::font_test
