// tests/music/scala_test.cpp: scales and key maps in Scala files.
#include "music/scale/scale.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace sikku::scala_test {

/// What a reader made of a text.
template <typename What>
struct Read {
    std::optional<What> value;
    std::vector<Diagnostic> mistakes;

    /// `3:2 message`, one a line.
    std::string told() const {
        std::string text;
        for (const Diagnostic& one : mistakes) {
            text += std::to_string(one.where.line) + ":" + std::to_string(one.where.column) + " " +
                    (one.warning ? "warning: " : "") + one.message + "\n";
        }
        return text;
    }
};

Read<Scale> scl(const std::string& text, const std::string& name = "folder/some.scl") {
    Diagnostics diagnostics;
    const Source source(name, text);
    auto scale = read_scl(source, diagnostics);
    EXPECT_EQ(scale.has_value(), !diagnostics.has_errors()) << text;
    return {std::move(scale), diagnostics.sorted()};
}

Read<KeyMap> kbm(const std::string& text) {
    Diagnostics diagnostics;
    const Source source("some.kbm", text);
    auto map = read_kbm(source, diagnostics);
    EXPECT_EQ(map.has_value(), !diagnostics.has_errors()) << text;
    return {std::move(map), diagnostics.sorted()};
}

/// The scale of a text without any mistake or warning.
Scale good_scl(const std::string& text) {
    const auto read = scl(text);
    EXPECT_EQ(read.told(), "") << text;
    return read.value.value_or(Scale());
}

KeyMap good_kbm(const std::string& text) {
    const auto read = kbm(text);
    EXPECT_EQ(read.told(), "") << text;
    return read.value.value_or(KeyMap());
}

double hertz(double key) {
    return 440.0 * std::exp2((key - 69.0) / 12.0);
}

/// The frequency of a key, 0 if the map leaves it out.
double sounding(const Scale& scale, const KeyMap& map, int key) {
    const auto mapped = mapped_key(scale, map, key);
    return mapped ? hertz(*mapped) : 0.0;
}

Scale equal(int division, double period = 1200.0) {
    Scale scale;
    for (int i = 0; i < division; ++i) scale.ascent.push_back(period * i / division);
    scale.descent = scale.ascent;
    scale.period = period;
    return scale;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
}

TEST(Scl, IsCentsAndRatiosUpToThePeriod) {
    const Scale scale = good_scl(
        "! meanquar.scl\n"
        "!\n"
        "1/4-comma meantone scale. Pietro Aaron's temperament (1523)\n"
        " 12\n"
        "!\n"
        " 76.04900\n 193.15686\n 310.26471\n 5/4\n 503.42157\n 579.47057\n 696.57843\n 25/16\n 889.73529\n"
        " 1006.84314\n 1082.89214\n 2/1\n");
    EXPECT_EQ(scale.id, "some");
    EXPECT_EQ(scale.title, "1/4-comma meantone scale. Pietro Aaron's temperament (1523)");
    EXPECT_EQ(scale.group, "scala");
    EXPECT_EQ(scale.sources, "folder/some.scl");
    EXPECT_EQ(scale.size(), 12U);
    EXPECT_EQ(scale.period, 1200.0);
    EXPECT_EQ(scale.ascent[0], 0.0);
    EXPECT_EQ(scale.ascent[1], 76.049);
    EXPECT_NEAR(scale.ascent[4], 386.3137138648348, 1e-9);
    EXPECT_NEAR(scale.ascent[8], 772.6274277296696, 1e-9);
    EXPECT_EQ(scale.descent, scale.ascent);
    EXPECT_NEAR(scale.cents(-1, false), -117.10786, 1e-9);
    EXPECT_NEAR(scale.cents(28, true), 2 * 1200.0 + 386.3137138648348, 1e-9);
}

TEST(Scl, IgnoresWhatFollowsANumber) {
    expect_near(
        good_scl("x\n 5 notes, or so\n 9/8 ! a tone\n386.3 cents\n\t4/3\tfa\n3/2!sol\n2/1 1/1 5.0\nthe end\n").ascent,
        {0, 203.91000173077484, 386.3, 498.0449991346125, 701.9550008653874});
    expect_near(good_scl("x\n2\n100. c#\n2/1").ascent, {0, 100});
}

TEST(Scl, HasEveryKindOfNumber) {
    const Scale scale = good_scl("x\n11\n-5.25\n386.\n.5\n+7.5\n3\n3/2\n007/004\n4/3\n1/2\n0.0\n 5\n");
    expect_near(scale.ascent, {0, -5.25, 386, 0.5, 7.5, 1901.9550008653874, 701.9550008653874, 968.8259064691249,
                               498.0449991346125, -1200, 0});
    EXPECT_NEAR(scale.period, 2786.3137138648348, 1e-9);
    // Bare numbers that look like cents are told.
    const auto bare = scl("x\n3\n700\n900\n1200\n");
    ASSERT_TRUE(bare.value);
    EXPECT_EQ(bare.told(), "3:1 warning: without a point this is the ratio 700/1, not 700 cents\n");
    EXPECT_NEAR(bare.value->ascent[1], 1200.0 * std::log2(700.0), 1e-9);
}

TEST(Scl, HasRatiosOfAnyLength) {
    // Eight fifths less octaves and 53 fifths: 3^53 / 2^84.
    const Scale scale = good_scl("x\n2\n19383245667680019896796723/19342813113834066795298816\n2/1\n");
    EXPECT_NEAR(scale.ascent[1], 3.615045866194, 1e-9);
    // 2^200 over 2^199 - the digits are beyond 64 bits, the quotient is plain.
    const Scale octave = good_scl(
        "x\n1\n1606938044258990275541962092341162602522202993782792835301376/"
        "803469022129495137770981046170581301261101496891396417650688\n");
    EXPECT_EQ(octave.period, 1200.0);
}

TEST(Scl, NeedsNeitherOrderNorAnOctave) {
    const Scale scale = good_scl("Unsorted\n5\n700.0\n-30.0\n1300.0\n200.0\n3/1\n");
    EXPECT_EQ(scale.ascent, (std::vector<double>{0, 700, -30, 1300, 200}));
    EXPECT_NEAR(scale.period, 1901.9550008653874, 1e-9);
    EXPECT_EQ(scale.cents(2, false), -30.0);
    EXPECT_NEAR(scale.cents(-1, false), 200.0 - 1901.9550008653874, 1e-9);
    EXPECT_EQ(good_scl("Falls\n2\n-100.0\n1/2\n").period, -1200.0);
    EXPECT_EQ(good_scl("One\n1\n78.0\n").cents(-3, true), -234.0);
}

TEST(Scl, HasAnyLineEnd) {
    const std::string text = "! c\nName\n3\n! c\n9/8\n!\n3/2\n2/1\n";
    for (const std::string end : {"\r\n", "\r", "\n"}) {
        std::string other;
        for (const char byte : text) {
            if (byte == '\n') {
                other += end;
            } else {
                other += byte;
            }
        }
        EXPECT_EQ(good_scl(other).title, "Name");
        EXPECT_EQ(good_scl(other).ascent.size(), 3U);
        other.resize(other.size() - end.size());  // the last line needs none
        EXPECT_EQ(good_scl(other).ascent.size(), 3U);
    }
    EXPECT_EQ(good_scl("\xEF\xBB\xBF! c\r\nName\r\n1\r\n2/1\r\n").title, "Name");
    // Neither comments of C nor continued lines mean anything here.
    EXPECT_EQ(good_scl("/* a // b \\\n2\n3/2 /* not\n2/1 closed\n").title, "/* a // b \\");
}

TEST(Scl, MayHaveNoDescriptionAndBlankLines) {
    const Scale scale = good_scl("\n2\n\n3/2\n   \n! c\n\n2/1\n\n");
    EXPECT_EQ(scale.title, "");
    EXPECT_EQ(scale.ascent.size(), 2U);
}

TEST(Scl, MayBeLatin1OrUtf8) {
    EXPECT_EQ(good_scl("Gamelan S\xE9kar \xDF\n1\n2/1 \xA7\n").title, "Gamelan Sékar ß");
    EXPECT_EQ(good_scl("Gamelan Sékar ß\n1\n2/1 §\n").title, "Gamelan Sékar ß");
    // A comment of Latin-1 does not make the description one.
    EXPECT_EQ(good_scl("! \xE9\nSékar\n1\n2/1\n").title, "Sékar");
}

TEST(Scl, IsNamedAfterItsFile) {
    EXPECT_EQ(scl("x\n1\n2/1\n", "/a/b.c/carlos_alpha.scl").value->id, "carlos_alpha");
    EXPECT_EQ(scl("x\n1\n2/1\n", "bp.SCL").value->id, "bp");
    EXPECT_EQ(scl("x\n1\n2/1\n", "-").value->id, "-");
}

TEST(Scl, TellsEachMistakeAtItsPlace) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "1:1 this is not a Scala scale: a description, the number of notes and the notes are missing\n"},
        {"! only\n! comments\n",
         "3:1 this is not a Scala scale: a description, the number of notes and the notes are missing\n"},
        {"Name\n", "2:1 after the description the number of notes is missing\n"},
        {"Name\n\n2/1\n", "2:1 the second line has to be the number of notes\n"},
        {"Name\n two\n2/1\n", "2:2 the second line has to be the number of notes, not 'two'\n"},
        {"Name\n1.5\n2/1\n", "2:1 the second line has to be the number of notes, not '1.5'\n"},
        {"Name\n-1\n2/1\n", "2:1 the second line has to be the number of notes, not '-1'\n"},
        {"Name\n99999999999999999999\n2/1\n",
         "2:1 the second line has to be the number of notes, not '99999999999999999999'\n"},
        {"Name\n 0\n", "2:2 a scale without notes cannot be played\n"},
        {"Name\n3\n9/8\n2/1\n", "5:1 1 of the 3 notes are missing\n"},
        {"Name\n9000000000000000000\n9/8\n2/1\n",
         "5:1 8999999999999999998 of the 9000000000000000000 notes are missing\n"},
        {"! c\nName\n2\n  what 1\n2/1\n", "4:3 'what' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n701,955\n2/1\n", "3:1 '701,955': cents are written with a point, as 701.955\n"},
        {"Name\n2\n701.955.0\n2/1\n", "3:1 '701.955.0' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n.\n2/1\n", "3:1 '.' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n-.\n2/1\n", "3:1 '-.' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n1.e5\n2/1\n", "3:1 '1.e5' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n3.0/2\n2/1\n", "3:1 '3.0/2' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\nnan\n2/1\n", "3:1 'nan' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n0x10\n2/1\n", "3:1 '0x10' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n3/\n2/1\n", "3:1 '3/' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n/2\n2/1\n", "3:1 '/2' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n3/2/1\n2/1\n", "3:1 '3/2/1' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n-\n2/1\n", "3:1 '-' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n3 / 2\n2/1\n", "3:1 a ratio is written without blanks: 3/2\n"},
        {"Name\n2\n3 /2\n2/1\n", "3:1 a ratio is written without blanks: 3/2\n"},
        {"Name\n2\n3/ 2\n2/1\n", "3:1 a ratio is written without blanks: 3/2\n"},
        {"Name\n2\n0/3\n2/1\n", "3:1 the ratio '0/3' is not a pitch: expected numbers above 0\n"},
        {"Name\n2\n3/0\n2/1\n", "3:1 the ratio '3/0' is not a pitch: expected numbers above 0\n"},
        {"Name\n2\n0\n2/1\n", "3:1 the ratio '0' is not a pitch: expected numbers above 0\n"},
        {"Name\n2\n-3/2\n2/1\n", "3:1 '-3/2' is a ratio below 0; negative cents are written with a point: -5.0\n"},
        {"Name\n2\n-5\n2/1\n", "3:1 '-5' is a ratio below 0; negative cents are written with a point: -5.0\n"},
        {"Name\n2\n3/-2\n2/1\n", "3:1 '3/-2' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n1e400.\n2/1\n", "3:1 '1e400.' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
        {"Name\n2\n999999999.0\n2/1\n", "3:1 '999999999.0' cents are beyond the 240000 that are allowed\n"},
        {"Name\n2\n1/" + std::string(100, '9') + "\n2/1\n",
         "3:1 the ratio '1/999999999999999999 … 99999999999999999999' is beyond the 240000 cents that are allowed\n"},
        {"Name\n2\n" + std::string(400, '9') + "/1\n2/1\n", "3:1 the numbers of this ratio are too large\n"},
        {"Name\n2\n3/2\n0.0\n",
         "4:1 the last line is the period, at which the scale repeats; it cannot be 0 cents\n"},
        {"Name\n1\n1/1\n", "3:1 the last line is the period, at which the scale repeats; it cannot be 0 cents\n"},
        {"Name\n2\n ! no comment\n2/1\n", "3:2 a comment has its ! at the very beginning of the line\n"},
        // All at once, in any line end.
        {"Name\r\n4\r\nx\r\n3/2\r\n \t0/1\r\n",
         "3:1 'x' is neither cents, as 701.955, nor a ratio, as 3/2\n"
         "5:3 the ratio '0/1' is not a pitch: expected numbers above 0\n"
         "6:1 1 of the 4 notes are missing\n"},
        {"S\xC3\xA9kar\n2\n\xE9t\xE9\n2/1\n", "3:1 'été' is neither cents, as 701.955, nor a ratio, as 3/2\n"},
    };
    for (const auto& [text, expected] : cases) EXPECT_EQ(scl(text).told(), expected) << text;
    EXPECT_EQ(scl(std::string("Name\n1\n2/1\0\n", 12)).told(),
              "3:4 this is not a Scala scale: it holds a NUL byte\n");
    EXPECT_EQ(scl(std::string("N\0a\0m\0e\0", 8)).told(), "1:2 this is not a Scala scale: it holds a NUL byte\n");
    EXPECT_EQ(scl(std::string(17'000'000, ' ')).told(), "1:1 this is too long for a Scala scale\n");
}

TEST(Scl, WarnsOfMoreNotesThanItTellsOf) {
    const auto read = scl("Name\n1\n3/2\n2/1\n5/1\n");
    ASSERT_TRUE(read.value);
    EXPECT_EQ(read.told(), "4:1 warning: there are more than 1 notes; the rest is ignored\n");
    EXPECT_EQ(scl("Name\n1\n2/1\n[info]\nwritten by me\n\x1A").told(), "");
}

TEST(Scl, IsReadTheSameInAnyLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    std::setlocale(LC_ALL, "de_DE.UTF-8");  // where there is none, nothing is lost
    EXPECT_EQ(good_scl("x\n2\n701.5\n2/1\n").ascent[1], 701.5);
    std::setlocale(LC_ALL, before.c_str());
}

/// Random files in every manner of writing, compared with the numbers they were written from.
TEST(Scl, GivesBackFiveHundredRandomScales) {
    std::mt19937 random(500);
    const auto below = [&](std::uint32_t limit) { return static_cast<int>(random() % limit); };
    const std::vector<std::string> remarks = {"", " ! third", " cents", "\tc#", "  (wolf) 3/2", "!", " !"};
    for (int round = 0; round < 500; ++round) {
        const int count = 1 + below(round % 10 == 0 ? 600 : 24);
        const std::string end = std::vector<std::string>{"\n", "\r\n", "\r"}[static_cast<std::size_t>(below(3))];
        std::string text = below(2) == 0 ? "! name.scl" + end + "!" + end : "";
        const std::string title = below(4) == 0 ? "" : "Scale " + std::to_string(round);
        text += title + end;
        text += std::string(static_cast<std::size_t>(below(3)), ' ') + std::to_string(count) +
                (below(3) == 0 ? " notes" : "") + end;
        std::vector<long double> expected = {0.0L};
        for (int i = 0; i < count; ++i) {
            if (below(5) == 0) text += "! " + std::to_string(below(100)) + "/7" + end;
            if (below(9) == 0) text += end;
            text += std::string(static_cast<std::size_t>(below(3)), below(2) == 0 ? ' ' : '\t');
            if (below(2) == 0) {
                const int milli = below(2'400'000) - 400'000 + 1;
                const int whole = std::abs(milli) / 1000;
                std::string digits = std::to_string(1000 + std::abs(milli) % 1000).substr(1);
                while (digits.ends_with('0')) digits.pop_back();
                text += (milli < 0 ? "-" : "") + std::to_string(whole) + "." + digits;
                expected.push_back(static_cast<long double>(milli) / 1000.0L);
            } else {
                const int above = 2 + below(97);
                const int divisor = below(5) == 0 ? 1 : 1 + below(60);
                text += std::to_string(above) + (divisor == 1 && below(2) == 0 ? "" : "/" + std::to_string(divisor));
                expected.push_back(
                    1200.0L / std::log(2.0L) *
                    (std::log(static_cast<long double>(above)) - std::log(static_cast<long double>(divisor))));
            }
            text += remarks[random() % remarks.size()] + end;
        }
        if (std::fabs(expected.back()) < 1e-9L) continue;
        const Scale scale = good_scl(text);
        EXPECT_EQ(scale.title, title);
        ASSERT_EQ(scale.ascent.size(), static_cast<std::size_t>(count)) << text;
        for (std::size_t i = 0; i < scale.ascent.size(); ++i) {
            ASSERT_NEAR(scale.ascent[i], static_cast<double>(expected[i]), 1e-9) << text;
        }
        ASSERT_NEAR(scale.period, static_cast<double>(expected.back()), 1e-9) << text;
        for (int degree = -3 * count; degree <= 3 * count; degree += 1 + count / 7) {
            int turn = 0;
            int place = degree;
            for (; place < 0; place += count) --turn;
            for (; place >= count; place -= count) ++turn;
            ASSERT_NEAR(scale.cents(degree, round % 2 == 0),
                        static_cast<double>(expected[static_cast<std::size_t>(place)] + turn * expected.back()),
                        1e-7);
        }
    }
}

/// Whatever the bytes are, they end in a scale or in a mistake with a place.
TEST(Scl, SurvivesRandomBytes) {
    std::mt19937 random(7);
    const std::string alphabet("0123456789./-+!x \t\r\n\n\n\xE9\xC3\xA9\0", 26);
    for (int round = 0; round < 3000; ++round) {
        std::string text = round % 2 == 0 ? "a\n3\n" : "";
        for (auto i = random() % 40; i > 0; --i) text += alphabet[random() % alphabet.size()];
        const auto scale = scl(text);
        const auto map = kbm(text);
        for (const Diagnostic& one : scale.mistakes) EXPECT_GE(one.where.line, 1);
        if (scale.value) {
            EXPECT_TRUE(std::isfinite(scale.value->cents(5, false)));
            if (map.value) mapped_key(*scale.value, *map.value, 64);
        }
    }
}

// --- key maps ---------------------------------------------------------------------------------------------------

const std::string white_keys =
    "! white.kbm\n"
    "! Size:\n12\n"
    "! First and last:\n0\n127\n"
    "60 middle\n69\n440.0 Hz\n"
    "! Formal octave:\n7\n"
    "! Mapping:\n0\nx\n1\nx\n2\n3\nx\n4\nx\n5\nx\n6\n";

TEST(Kbm, HasAHeadAndDegrees) {
    const KeyMap map = good_kbm(white_keys);
    EXPECT_EQ(map.first, 0);
    EXPECT_EQ(map.last, 127);
    EXPECT_EQ(map.middle, 60);
    EXPECT_EQ(map.reference, 69);
    EXPECT_EQ(map.frequency, 440.0);
    EXPECT_EQ(map.octave_degree, 7);
    ASSERT_EQ(map.degrees.size(), 12U);
    EXPECT_EQ(map.degrees[0], 0);
    EXPECT_EQ(map.degrees[1], std::nullopt);
    EXPECT_EQ(map.degrees[11], 6);
    const KeyMap linear = good_kbm("0\r\n21\r\n108\r\n60\r\n60\r\n261.625565\r\n0\r\n");
    EXPECT_TRUE(linear.degrees.empty());
    EXPECT_EQ(linear.first, 21);
    EXPECT_EQ(linear.frequency, 261.625565);
    // Left out at the end as well.
    const KeyMap brief = good_kbm("4\n0\n127\n60\n60\n440\n0\n0\nX\n-3\n");
    EXPECT_EQ(brief.degrees, (std::vector<std::optional<int>>{0, std::nullopt, -3, std::nullopt}));
}

TEST(Kbm, TellsEachMistakeAtItsPlace) {
    const std::string head = "0\n127\n60\n69\n440.0\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "1:1 this key map ends too early: the size of the map is missing\n"},
        {"! c\n12\n0\n127\n60\n", "6:1 this key map ends too early: the key whose frequency is given is missing\n"},
        {"12\n0\n127\n60\n69\n", "6:1 this key map ends too early: the frequency is missing\n"},
        {"12\n" + head, "7:1 this key map ends too early: the degree of the formal octave is missing\n"},
        {" many\n" + head + "0\n", "1:2 the size of the map is a whole number, not 'many'\n"},
        {"-1\n" + head + "0\n", "1:1 the size of the map lies from 0 to 100000\n"},
        {"999999999999\n" + head + "0\n", "1:1 the size of the map lies from 0 to 100000\n"},
        {"99999999999999999999\n" + head + "0\n",
         "1:1 the size of the map is a whole number, not '99999999999999999999'\n"},
        {"0\n-1\n128\n200\n-5\n440\n0\n",
         "2:1 the first key lies from 0 to 127\n3:1 the last key lies from 0 to 127\n"
         "4:1 the middle key lies from 0 to 127\n5:1 the key whose frequency is given lies from 0 to 127\n"},
        {"0\n100\n50\n60\n69\n440\n0\n", "3:1 the last key lies below the first\n"},
        {"0\n0\n127\n60\n69\n440,0\n0\n", "6:1 the frequency is a number of Hz, as 440.0, not '440,0'\n"},
        {"0\n0\n127\n60\n69\n0.0\n0\n", "6:1 the frequency lies above 0 and up to 1000000 Hz\n"},
        {"0\n0\n127\n60\n69\n-440\n0\n", "6:1 the frequency lies above 0 and up to 1000000 Hz\n"},
        {"0\n0\n127\n60\n69\n1e300\n0\n", "6:1 the frequency lies above 0 and up to 1000000 Hz\n"},
        {"0\n0\n127\n60\n69\ninf\n0\n", "6:1 the frequency is a number of Hz, as 440.0, not 'inf'\n"},
        {"0\n0\n127\n60\n69\n440\n1000000\n", "7:1 the degree of the formal octave lies from -100000 to 100000\n"},
        {"3\n" + head + "0\n0\ny\n1.5\n",
         "9:1 a degree is a whole number or x, not 'y'\n10:1 a degree is a whole number or x, not '1.5'\n"},
        {"1\n" + head + "0\n1000000\n", "8:1 degrees lie from -100000 to 100000\n"},
        {"2\n" + head + "0\n0\nx\n", "5:1 the map leaves out key 69, whose frequency is given\n"},
        {"12\n" + head + "0\n0\n", "5:1 the map leaves out key 69, whose frequency is given\n"},
    };
    for (const auto& [text, expected] : cases) EXPECT_EQ(kbm(text).told(), expected) << text;
    EXPECT_EQ(kbm(std::string("0\n\0", 3)).told(), "2:1 this is not a Scala key map: it holds a NUL byte\n");
    EXPECT_EQ(kbm("1\n" + head + "0\n0\n1\n").told(),
              "9:1 warning: there are more than 1 degrees; the rest is ignored\n");
    EXPECT_EQ(kbm("0\n" + head + "0\n0\n1\n").told(),
              "8:1 warning: the size of this map is 0; the rest of the file is ignored\n");
}

TEST(MappedKey, IsTheKeyItselfInTwelveEqualSteps) {
    const KeyMap standard;
    for (int key = 0; key <= 127; ++key) {
        EXPECT_NEAR(mapped_key(equal(12), standard, key).value(), key, 1e-9);
        EXPECT_NEAR(mapped_key(*find_scale("chromatic"), standard, key).value(), key, 1e-9);
    }
    EXPECT_NEAR(sounding(equal(12), standard, 69), 440.0, 1e-9);
    EXPECT_NEAR(sounding(equal(12), standard, 60), 261.6255653005986, 1e-9);
    KeyMap baroque;
    baroque.frequency = 415.3046975799451;  // a semitone lower
    EXPECT_NEAR(mapped_key(equal(12), baroque, 69).value(), 68.0, 1e-9);
}

TEST(MappedKey, GoesThroughOtherDivisions) {
    KeyMap map;
    // 19 equal steps: nineteen keys above A is twice 440 Hz.
    EXPECT_NEAR(sounding(equal(19), map, 69), 440.0, 1e-9);
    EXPECT_NEAR(sounding(equal(19), map, 88), 880.0, 1e-9);
    EXPECT_NEAR(mapped_key(equal(19), map, 70).value(), 69.0 + 12.0 / 19.0, 1e-9);
    EXPECT_NEAR(mapped_key(equal(19), map, 60).value(), 69.0 - 9 * 12.0 / 19.0, 1e-9);
    EXPECT_NEAR(sounding(equal(19), map, 60), 440.0 * std::pow(2.0, -9.0 / 19.0), 1e-9);
    // Bohlen-Pierce: thirteen keys are three times the frequency.
    const Scale& bohlen_pierce = *find_scale("bohlen-pierce");
    map.reference = 60;
    map.frequency = 100.0;
    EXPECT_NEAR(sounding(bohlen_pierce, map, 60), 100.0, 1e-9);
    EXPECT_NEAR(sounding(bohlen_pierce, map, 73), 300.0, 1e-9);
    EXPECT_NEAR(sounding(bohlen_pierce, map, 86), 900.0, 1e-9);
    EXPECT_NEAR(sounding(bohlen_pierce, map, 47), 100.0 / 3.0, 1e-9);
    EXPECT_NEAR(sounding(bohlen_pierce, map, 61), 100.0 * std::pow(3.0, 1.0 / 13.0), 1e-9);
}

TEST(MappedKey, LeavesGaps) {
    // A is 5/3 above C, so C is 264 Hz; everything else follows by hand.
    const Scale& just = *find_scale("just-major");
    const KeyMap map = good_kbm(white_keys);
    for (const auto& [key, frequency] :
         {std::pair{60, 264.0}, std::pair{61, 0.0}, std::pair{62, 297.0}, std::pair{63, 0.0}, std::pair{64, 330.0},
          std::pair{65, 352.0}, std::pair{66, 0.0}, std::pair{67, 396.0}, std::pair{69, 440.0}, std::pair{71, 495.0},
          std::pair{72, 528.0}, std::pair{59, 247.5}, std::pair{58, 0.0}, std::pair{57, 220.0}, std::pair{48, 132.0},
          std::pair{0, 8.25}, std::pair{127, 12672.0}}) {
        EXPECT_NEAR(sounding(just, map, key), frequency, 1e-8) << key;
    }
}

TEST(MappedKey, TakesTheFormalOctaveFromADegree) {
    // Three keys for a pattern that goes on at the fifth, which is degree 4 of the scale.
    KeyMap map = good_kbm("3\n0\n127\n60\n60\n100.0\n4\n0\n2\n7\n");
    const Scale& just = *find_scale("just-major");
    EXPECT_NEAR(sounding(just, map, 60), 100.0, 1e-9);
    EXPECT_NEAR(sounding(just, map, 61), 125.0, 1e-9);
    EXPECT_NEAR(sounding(just, map, 62), 200.0, 1e-9);
    EXPECT_NEAR(sounding(just, map, 63), 150.0, 1e-9);
    EXPECT_NEAR(sounding(just, map, 66), 225.0, 1e-9);
    EXPECT_NEAR(sounding(just, map, 57), 100.0 / 1.5, 1e-9);
    // 0 is the period of the scale; degrees may lie below the middle.
    map = good_kbm("2\n0\n127\n60\n60\n100.0\n0\n0\n-1\n");
    EXPECT_NEAR(sounding(*find_scale("bohlen-pierce"), map, 62), 300.0, 1e-9);
    EXPECT_NEAR(sounding(just, map, 61), 100.0 * 15 / 16, 1e-9);
    // An octave of the scale has 7 degrees, and any other number of them is what it is.
    map = good_kbm("2\n0\n127\n60\n60\n100.0\n7\n0\n1\n");
    EXPECT_NEAR(sounding(just, map, 64), 400.0, 1e-9);
    map = good_kbm("2\n0\n127\n60\n60\n100.0\n-7\n0\n1\n");
    EXPECT_NEAR(sounding(just, map, 64), 25.0, 1e-9);
}

TEST(MappedKey, EndsWithItsKeys) {
    KeyMap map = good_kbm("0\n48\n72\n60\n90\n440.0\n0\n");
    EXPECT_FALSE(mapped_key(equal(12), map, 47));
    EXPECT_TRUE(mapped_key(equal(12), map, 48));
    EXPECT_TRUE(mapped_key(equal(12), map, 72));
    EXPECT_FALSE(mapped_key(equal(12), map, 73));
    // The key of the given frequency need not be among them.
    EXPECT_NEAR(mapped_key(equal(12), map, 72).value(), 69.0 - 18.0, 1e-9);
    // Made by hand, without the degree it is tuned by.
    map.degrees = {0, std::nullopt};
    map.reference = 61;
    EXPECT_FALSE(mapped_key(equal(12), map, 60));
}

}  // namespace sikku::scala_test
