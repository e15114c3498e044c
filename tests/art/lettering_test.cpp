#include "engine/geometry/lettering.h"

#include "art/print/page.h"
#include "engine/geometry/tamil.h"
#include "engine/language/pattern.h"
#include "tests/checks.h"
#include "tests/files.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace sikku::lettering_test {

/// Everything that was written, flattened to its control points.
class Written : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        pens.push_back(pen);
        box.add(start);
        ++strokes;
        open = true;
    }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) box.add(end);
        segments += ends.size();
    }
    void curves(std::span<const glm::dvec2> controls) override {
        for (const glm::dvec2 control : controls) box.add(control);
        segments += controls.size() / 3;
    }
    void change_pen(const Pen&) override { FAIL(); }
    void end_stroke(bool) override { open = false; }
    void polygon(std::span<const glm::dvec2>, const Pen&) override { FAIL(); }
    void disc(glm::dvec2, double, const Pen&) override { FAIL(); }

    Box box;
    std::vector<Pen> pens;
    std::size_t strokes = 0, segments = 0;
    bool open = false;
};

Written written(std::string_view text, double height, glm::dvec2 start = glm::dvec2(0.0)) {
    Written sink;
    write_text(text, start, height, Pen{.width = 0.25, .width_set = true, .colour = 1}, sink);
    EXPECT_FALSE(sink.open);
    return sink;
}

TEST(Lettering, CapitalsAreAsHighAsAskedAndStandOnTheLine) {
    for (const double height : {1.0, 2.5, 40.0}) {
        const Written sink = written("HEXLT", height, {7.0, -3.0});
        EXPECT_NEAR(sink.box.low.y, -3.0, 1e-9);
        EXPECT_NEAR(sink.box.high.y, -3.0 + height, 1e-9);
        EXPECT_GE(sink.box.low.x, 7.0);
        EXPECT_LE(sink.box.high.x, 7.0 + text_width("HEXLT", height));
        for (const Pen& pen : sink.pens) EXPECT_EQ(pen, (Pen{.width = 0.25, .width_set = true, .colour = 1}));
    }
}

TEST(Lettering, EveryAsciiCharacterIsWrittenWithinItsRoom) {
    for (char letter = '!'; letter <= '~'; ++letter) {
        const std::string text(1, letter);
        EXPECT_TRUE(has_letters(text)) << text;
        const Written sink = written(text, 1.0);
        EXPECT_GT(sink.strokes, 0u) << text;
        EXPECT_GT(sink.segments, 0u) << text;
        EXPECT_GE(sink.box.low.x, -0.2) << text;
        EXPECT_LE(sink.box.high.x, text_width(text, 1.0) + 0.2) << text;
        EXPECT_GE(sink.box.low.y, -letter_descent) << text;
        EXPECT_LE(sink.box.high.y, letter_ascent) << text;
    }
    EXPECT_EQ(written(" ", 1.0).strokes, 0u);
    EXPECT_GT(text_width(" ", 1.0), 0.3);
}

TEST(Lettering, WidthsAddUpAndGrowWithTheHeight) {
    const double width = text_width("Kolam", 3.0);
    EXPECT_NEAR(text_width("Ko", 3.0) + text_width("lam", 3.0), width, 1e-9);
    EXPECT_NEAR(text_width("Kolam", 6.0), 2 * width, 1e-9);
    EXPECT_EQ(text_width("", 3.0), 0.0);
    EXPECT_LT(text_width("i", 1.0), text_width("M", 1.0));
}

TEST(Lettering, AccentsAreComposed) {
    for (const std::string_view text : {"äöüÄÖÜß", "áéíóúñÁÉÑ", "Sierpiński", "àâçèêëîïôùû", "ṭṇḷṣśṅñṟṛḥṃṁ", "āīūēō",
                                        "čřšžěů", "łŁøØåÅ", "őű", "șțăâî", "ğışİ"}) {
        EXPECT_TRUE(has_letters(text)) << text;
    }
    // An accent takes no room, and stands above the letter; the dot of the i gives way to it.
    EXPECT_EQ(text_width("é", 1.0), text_width("e", 1.0));
    EXPECT_EQ(text_width("e\u0301", 1.0), text_width("e", 1.0));
    EXPECT_GT(written("é", 1.0).box.high.y, written("e", 1.0).box.high.y + 0.1);
    EXPECT_LT(written("ṇ", 1.0).box.low.y, written("n", 1.0).box.low.y - 0.1);
    EXPECT_EQ(written("í", 1.0).strokes, written("i", 1.0).strokes);
    const Written composed = written("ń", 1.0), combined = written("n\u0301", 1.0);
    EXPECT_EQ(composed.box.high, combined.box.high);
    EXPECT_EQ(composed.segments, combined.segments);
}

TEST(Lettering, WhatTheFontDoesNotHaveIsABox) {
    for (const std::string_view text : {"௧", "日", "\x80", "\xff", "\x01"}) {
        EXPECT_FALSE(has_letters(text));
        EXPECT_GT(written(text, 1.0).strokes, 0u);
    }
    EXPECT_EQ(text_width("日本", 1.0), 2 * text_width("日", 1.0));
    EXPECT_TRUE(has_letters("F → F−F · 60° × 2 – “x” … ’"));
}

TEST(Lettering, TheTextsOfAllPatternsCanBeWritten) {
    for (const auto& file : pattern_files("patterns")) {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern(file.string(), contents(file), diagnostics);
        for (const char* key : {"title", "source", "description"}) {
            EXPECT_TRUE(has_letters(pattern.text(key))) << file << ": " << pattern.text(key);
        }
    }
}

TEST(Lettering, LongTextsAreShortened) {
    const std::string text = "Quadratic Koch island";
    const double width = text_width(text, 2.0);
    EXPECT_EQ(shortened(text, 2.0, width), text);
    for (const double part : {0.99, 0.5, 0.2}) {
        const std::string less = shortened(text, 2.0, part * width);
        EXPECT_TRUE(less.ends_with("…")) << less;
        EXPECT_LE(text_width(less, 2.0), part * width);
        EXPECT_FALSE(has(less, " …"));
    }
    EXPECT_EQ(shortened(text, 2.0, 0.1), "");
    // Never within a character, nor between a letter and its mark.
    const std::string accented = "e\u0301e\u0301e\u0301e\u0301e\u0301e\u0301";
    const double two = 2.2 * text_width("e", 1.0) + text_width("…", 1.0);
    EXPECT_EQ(shortened(accented, 1.0, two), "e\u0301e\u0301…");
}

TEST(Lettering, LinesBreakAtSpacesAndElseWithinWords) {
    const double width = text_width("mmmmmmmmmm", 1.0);
    EXPECT_EQ(wrapped("one", 1.0, width, 3), std::vector<std::string>{"one"});
    EXPECT_EQ(wrapped("", 1.0, width, 3), std::vector<std::string>{""});
    std::string all;
    for (const std::string& line : wrapped("a few words  that are longer than one line", 1.0, width, 9)) {
        EXPECT_LE(text_width(line, 1.0), width);
        EXPECT_FALSE(line.starts_with(' ') || line.ends_with(' '));
        if (!all.empty()) all += ' ';
        all += line;
    }
    EXPECT_EQ(all, "a few words  that are longer than one line");
    // A long word with hyphens, and a word without hyphens.
    EXPECT_EQ(wrapped("kolam-11-to-1-naq0sdh3", 1.0, text_width("kolam-11-to-1-naq", 1.0), 3),
              (std::vector<std::string>{"kolam-11-to-1-", "naq0sdh3"}));
    const std::string word(100, 'F');
    const auto lines = wrapped(word, 1.0, width, 50);
    EXPECT_GT(lines.size(), 3u);
    all.clear();
    for (const std::string& line : lines) all += line;
    EXPECT_EQ(all, word);
    const auto two = wrapped(word, 1.0, width, 2);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_TRUE(two.back().ends_with("…"));
    EXPECT_LE(text_width(two.back(), 1.0), width);
    // No room at all is no endless loop.
    EXPECT_EQ(wrapped(word, 1.0, 0.01, 5), std::vector<std::string>{""});
}

TEST(Lettering, QuotationMarksCurrenciesAndFractionsAreWritten) {
    for (const std::string_view text : {"„“”‚‘’«»‹›", "–—…·•", "€ ₹ £ ¥", "20° ½ ¼ ¾ 2² 3³ 1¹",
                                        "Æon Œuvre œ æ þ ð Þ Ð", "¿Qué? ¡Sí!", "© ® ™ ♥ ★", "′ ″ µ ÷ ≠ ∞ √", "a‑b"}) {
        EXPECT_TRUE(has_letters(text)) << text << ": " << missing_letters({std::string(text)});
    }
    EXPECT_LT(text_width("²", 1.0), text_width("2", 1.0));
    EXPECT_GT(written("²", 1.0).box.low.y, 0.3);
    EXPECT_EQ(text_width("\u00AD", 1.0), 0.0);
}

TEST(Lettering, MissingCharactersAreNamedOnce) {
    EXPECT_EQ(missing_letters({"Würzburg „Kolam“ €", "அன்பு & மீரா"}), "");
    EXPECT_EQ(missing_letters({"日本 日", "a日"}), "日 (U+65E5), 本 (U+672C)");
    EXPECT_EQ(missing_letters({"\xff", "\x01"}), "the byte 0xff, U+0001");
    EXPECT_EQ(letters_warning("日 (U+65E5)"), "the lettering font lacks 日 (U+65E5); an empty box replaces each");
}

std::u32string u32(std::string_view utf8) {
    std::u32string text;
    for (std::size_t i = 0; i < utf8.size();) {
        const auto lead = static_cast<unsigned char>(utf8[i]);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
        char32_t code = length == 1 ? lead : lead & (0x7Fu >> length);
        for (std::size_t k = 1; k < length; ++k) code = code << 6 | (static_cast<unsigned char>(utf8[i + k]) & 0x3Fu);
        text += code;
        i += length;
    }
    return text;
}

const std::vector<std::string> consonants = {"க", "ங", "ச", "ஞ", "ட", "ண", "த", "ந", "ப",  "ம", "ய", "ர",
                                             "ல", "வ", "ழ", "ள", "ற", "ன", "ஜ", "ஷ", "க்ஷ", "ஸ", "ஹ", "ஶ"};
const std::vector<std::string> signs = {"ா", "ி", "ீ", "ு", "ூ", "ெ", "ே", "ை", "ொ", "ோ", "ௌ", "்"};

TEST(Tamil, EverySyllableIsOneGlyphWithinItsRoom) {
    for (const char* vowel : {"அ", "ஆ", "இ", "ஈ", "உ", "ஊ", "எ", "ஏ", "ஐ", "ஒ", "ஓ", "ஔ", "ஃ", "ஸ்ரீ", "ஶ்ரீ"}) {
        EXPECT_TRUE(has_letters(vowel)) << vowel;
        EXPECT_EQ(tamil_syllable(u32(vowel))->characters, u32(vowel).size()) << vowel;
    }
    for (const std::string& consonant : consonants) {
        for (const std::string& sign : signs) {
            const std::string syllable = consonant + sign;
            ASSERT_TRUE(has_letters(syllable)) << syllable;
            // Nothing of the next syllable, and all of this one.
            const auto found = tamil_syllable(u32(syllable + "க"));
            ASSERT_TRUE(found);
            EXPECT_EQ(found->characters, u32(syllable).size()) << syllable;
            const Written sink = written(syllable, 1.0);
            EXPECT_GE(sink.box.low.x, 0.0) << syllable;
            EXPECT_LE(sink.box.high.x, text_width(syllable, 1.0)) << syllable;
            EXPECT_GE(sink.box.low.y, -letter_descent) << syllable;
            EXPECT_LE(sink.box.high.y, letter_ascent) << syllable;
            // A sign changes the glyph.
            const Written plain = written(consonant, 1.0);
            EXPECT_TRUE(sink.segments != plain.segments || sink.box.high != plain.box.high ||
                        sink.box.low != plain.box.low)
                << syllable;
        }
    }
}

TEST(Tamil, SignsStandWhereTheyAreRead) {
    const auto width = [](std::string_view text) { return text_width(text, 21.0); };
    // To the left: the sign alone, then the letter alone.
    for (const char* sign : {"ெ", "ே", "ை"}) {
        const std::string syllable = std::string("க") + sign;
        EXPECT_NEAR(width(syllable), width(sign) + width("க"), 1e-9);
        const auto whole = tamil_syllable(u32(syllable)), alone = tamil_syllable(u32(sign));
        ASSERT_GE(whole->strokes.size(), alone->strokes.size());
        EXPECT_EQ(whole->strokes[0].start, alone->strokes[0].start);
        EXPECT_GT(whole->strokes[alone->strokes.size()].start.x, alone->width);
    }
    // On both sides, whether the text has one character for the sign or two.
    using Spellings = std::pair<const char*, const char*>;
    for (const auto& [one, two] :
         {Spellings("\u0B95\u0BCA", "\u0B95\u0BC6\u0BBE"), Spellings("\u0B95\u0BCB", "\u0B95\u0BC7\u0BBE"),
          Spellings("\u0B95\u0BCC", "\u0B95\u0BC6\u0BD7")}) {
        EXPECT_EQ(written(one, 1.0).box.high, written(two, 1.0).box.high);
        EXPECT_EQ(written(one, 1.0).segments, written(two, 1.0).segments);
        EXPECT_EQ(width(one), width(two));
    }
    EXPECT_NEAR(width("கொ"), width("ெ") + width("க") + width("ா"), 1e-9);
    EXPECT_EQ(written("ஔ", 1.0).segments, written("ஒ\u0BD7", 1.0).segments);
    // A pulli takes no room, and stands above.
    EXPECT_EQ(width("க்"), width("க"));
    EXPECT_GT(written("க்", 1.0).box.high.y, written("க", 1.0).box.high.y + 0.1);
    // Before a consonant other than ssa it ends the syllable.
    EXPECT_EQ(tamil_syllable(u32("க்ஷா"))->characters, 4u);
    EXPECT_EQ(tamil_syllable(u32("க்கா"))->characters, 2u);
}

TEST(Tamil, TextsAreNeverCutWithinASyllable) {
    const std::string text = "கோலங்கள் மீனாட்சி";
    for (double part = 0.05; part < 1; part += 0.01) {
        const std::string less = shortened(text, 2.0, part * text_width(text, 2.0));
        if (less.empty()) continue;
        const std::string kept = less.substr(0, less.size() - std::string("…").size());
        EXPECT_TRUE(text.starts_with(kept));
        if (kept.size() == text.size()) continue;
        const char32_t next = u32(text.substr(kept.size())).front();
        EXPECT_FALSE(next >= 0x0BBE && next <= 0x0BD7) << less << ": a sign without its letter";
    }
}

TEST(Tamil, CurvesAreSmoothWhereAStrokeGoesOn) {
    // A loop closes with the tangent it began with, and has no corner.
    const auto ring = tamil_syllable(U"ஃ");
    ASSERT_EQ(ring->strokes.size(), 3u);
    for (const LetterStroke& stroke : ring->strokes) {
        EXPECT_TRUE(stroke.is_closed);
        ASSERT_EQ(stroke.pieces.size(), 4u);
        glm::dvec2 centre(0.0);
        for (const auto& piece : stroke.pieces) centre += piece.end / 4.0;
        glm::dvec2 from = stroke.start;
        for (const auto& piece : stroke.pieces) {
            EXPECT_TRUE(piece.is_curve);
            for (const double t : {0.25, 0.5, 0.75}) {
                const double s = 1 - t;
                const glm::dvec2 at = s * s * s * from + 3 * s * s * t * piece.first + 3 * s * t * t * piece.second +
                                      t * t * t * piece.end;
                EXPECT_NEAR(glm::distance(at, centre), 4.4, 0.003);
            }
            from = piece.end;
        }
    }
}

}  // namespace sikku::lettering_test
