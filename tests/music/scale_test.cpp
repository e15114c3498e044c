// tests/music/scale_test.cpp: the bundled scales, the melakarta, the degrees of melodies, `sikku scales`.
#include "music/scale/scale.h"

#include "music/melody/melody.h"
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::scale_test {

const Scale& scale_of(std::string_view name) {
    const Scale* scale = find_scale(name);
    if (!scale) throw std::runtime_error("no scale " + std::string(name));
    return *scale;
}

std::string id_of(std::string_view name) {
    const Scale* scale = find_scale(name);
    return scale ? scale->id : "none";
}

/// Steps of an equal division of the octave, which have to be whole.
std::vector<int> degrees(const std::vector<double>& cents, int division = 12) {
    std::vector<int> result;
    for (const double value : cents) {
        const double step = value * division / 1200.0;
        EXPECT_NEAR(step, std::round(step), 1e-9);
        result.push_back(static_cast<int>(std::lround(step)));
    }
    return result;
}

/// Degrees from a string of steps, one digit each, which has to close at the octave.
std::vector<int> from_steps(std::string_view steps, int division = 12) {
    std::vector<int> result;
    int at = 0;
    for (const char digit : steps) {
        result.push_back(at);
        at += digit - '0';
    }
    EXPECT_EQ(at, division) << steps;
    return result;
}

using Steps = std::pair<const char*, const char*>;

/// The steps of the twelve-tone scales, as textbooks and other programs have them.
constexpr std::array<Steps, 60> twelve_tone = {{
    {"major", "2212221"},
    {"dorian", "2122212"},
    {"phrygian", "1222122"},
    {"lydian", "2221221"},
    {"mixolydian", "2212212"},
    {"minor", "2122122"},
    {"locrian", "1221222"},
    {"harmonic-minor", "2122131"},
    {"melodic-minor", "2122221"},
    {"harmonic-major", "2212131"},
    {"melodic-major", "2212122"},
    {"phrygian-dominant", "1312122"},
    {"double-harmonic", "1312131"},
    {"hungarian-minor", "2131131"},
    {"hungarian-major", "3121212"},
    {"romanian-minor", "2131212"},
    {"neapolitan-minor", "1222131"},
    {"neapolitan-major", "1222221"},
    {"lydian-dominant", "2221212"},
    {"lydian-augmented", "2222121"},
    {"altered", "1212222"},
    {"locrian-major", "2211222"},
    {"lydian-minor", "2221122"},
    {"leading-whole-tone", "2222211"},
    {"persian", "1311231"},
    {"enigmatic", "1322211"},
    {"major-pentatonic", "22323"},
    {"minor-pentatonic", "32232"},
    {"suspended-pentatonic", "23232"},
    {"man-gong", "32322"},
    {"ritusen", "23223"},
    {"hirajoshi", "21414"},
    {"kumoi", "21423"},
    {"in-sen", "14232"},
    {"iwato", "14142"},
    {"kumoijoshi", "14214"},
    {"pelog-approx", "12414"},
    {"chinese", "42141"},
    {"indian-pentatonic", "41232"},
    {"scriabin", "13323"},
    {"blues", "321132"},
    {"major-blues", "211323"},
    {"whole-tone", "222222"},
    {"augmented", "313131"},
    {"six-tone-symmetric", "131313"},
    {"prometheus", "222312"},
    {"octatonic-half-whole", "12121212"},
    {"octatonic-whole-half", "21212121"},
    {"bebop-dominant", "22122111"},
    {"bebop-major", "22121121"},
    {"messiaen-3", "211211211"},
    {"messiaen-4", "11311131"},
    {"messiaen-5", "141141"},
    {"messiaen-6", "22112211"},
    {"messiaen-7", "1112111121"},
    {"todi-that", "1231131"},
    {"purvi-that", "1321131"},
    {"marva-that", "1321221"},
    {"ahir-bhairav", "1312212"},
    {"chromatic", "111111111111"},
}};

/// The maqamat of SuperCollider, rising, in quarter tones.
constexpr std::array<Steps, 36> quarter_tone = {{
    {"chromatic-24", "111111111111111111111111"},
    {"maqam-ajam", "4424442"},
    {"maqam-jiharkah", "4424433"},
    {"maqam-shawq-afza", "4424262"},
    {"maqam-sikah", "3443343"},
    {"maqam-sikah-desc", "3442443"},
    {"maqam-huzam", "3426243"},
    {"maqam-iraq", "3433443"},
    {"maqam-bastanikar", "3433263"},
    {"maqam-mustar", "5242443"},
    {"maqam-bayati", "3344244"},
    {"maqam-karjighar", "3342624"},
    {"maqam-husseini", "3344343"},
    {"maqam-nahawand", "4244262"},
    {"maqam-nahawand-desc", "4244244"},
    {"maqam-farahfaza", "4244244"},
    {"maqam-murassah", "4242624"},
    {"maqam-ushaq-mashri", "4244343"},
    {"maqam-rast", "4334433"},
    {"maqam-rast-desc", "4334424"},
    {"maqam-suznak", "4334262"},
    {"maqam-nairuz", "4334334"},
    {"maqam-yakah", "4334433"},
    {"maqam-yakah-desc", "4334424"},
    {"maqam-mahur", "4334442"},
    {"maqam-hijaz", "2624334"},
    {"maqam-hijaz-desc", "2624244"},
    {"maqam-zanjaran", "2624424"},
    {"maqam-hijaz-kar", "2624262"},
    {"maqam-saba", "3324444"},
    {"maqam-zamzam", "2426244"},
    {"maqam-kurd", "2444244"},
    {"maqam-kijaz-kar-kurd", "2624262"},
    {"maqam-nawa-athar", "4262262"},
    {"maqam-nikriz", "4262424"},
    {"maqam-athar-kurd", "2462262"},
}};

/// The 72 melakarta one after the other, by two loops for each half instead of a formula.
std::vector<std::vector<int>> melakarta() {
    std::vector<std::vector<int>> result;
    for (const int fourth : {5, 6}) {
        for (int second = 1; second <= 3; ++second) {
            for (int third = second + 1; third <= 4; ++third) {
                for (int sixth = 8; sixth <= 10; ++sixth) {
                    for (int seventh = sixth + 1; seventh <= 11; ++seventh) {
                        result.push_back({0, second, third, fourth, 7, sixth, seventh});
                    }
                }
            }
        }
    }
    return result;
}

std::vector<int> sounding(const Scale& scale, int from, int to, bool falling) {
    std::vector<int> result;
    for (int degree = from; degree <= to; ++degree) {
        result.push_back(static_cast<int>(std::lround(scale.cents(degree, falling) / 100.0)));
    }
    return result;
}

using Keys = std::vector<int>;

TEST(Scales, HaveTheStepsOfTheTextbooks) {
    for (const auto& [id, steps] : twelve_tone) {
        const Scale& scale = scale_of(id);
        EXPECT_EQ(scale.id, id);
        EXPECT_EQ(degrees(scale.ascent), from_steps(steps)) << id;
        EXPECT_EQ(scale.period, 1200.0);
        EXPECT_EQ(scale.descent == scale.ascent, scale.id != "melodic-minor") << id;
    }
    EXPECT_EQ(scale_of("melodic-minor").descent, scale_of("minor").ascent);
    EXPECT_EQ(scale_of("melodic-minor").ascent, scale_of("jazz-minor").ascent);
}

TEST(Scales, AreModesOfEachOther) {
    const auto mode = [](std::string_view name, int from) {
        const Scale& scale = scale_of(name);
        Keys result;
        for (int i = 0; i < static_cast<int>(scale.size()); ++i) {
            result.push_back(
                static_cast<int>(std::lround((scale.cents(from + i, false) - scale.cents(from, false)) / 100.0)));
        }
        return result;
    };
    const auto notes = [](std::string_view name) { return degrees(scale_of(name).ascent); };
    const std::array<const char*, 7> church = {"ionian",     "dorian",  "phrygian", "lydian",
                                               "mixolydian", "aeolian", "locrian"};
    for (int i = 0; i < 7; ++i) EXPECT_EQ(mode("major", i), notes(church[static_cast<std::size_t>(i)])) << i;
    // The ascending melodic minor and its modes.
    EXPECT_EQ(mode("jazz-minor", 2), notes("lydian-augmented"));
    EXPECT_EQ(mode("jazz-minor", 3), notes("lydian-dominant"));
    EXPECT_EQ(mode("jazz-minor", 4), notes("melodic-major"));
    EXPECT_EQ(mode("jazz-minor", 6), notes("altered"));
    EXPECT_EQ(mode("harmonic-minor", 3), notes("romanian-minor"));
    EXPECT_EQ(mode("harmonic-minor", 4), notes("phrygian-dominant"));
    EXPECT_EQ(mode("double-harmonic", 3), notes("hungarian-minor"));
    EXPECT_EQ(mode("neapolitan-major", 4), notes("locrian-major"));
    EXPECT_EQ(mode("augmented", 1), notes("six-tone-symmetric"));
    const std::array<const char*, 5> pentatonic = {"major-pentatonic", "suspended-pentatonic", "man-gong", "ritusen",
                                                   "minor-pentatonic"};
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(mode("major-pentatonic", i), notes(pentatonic[static_cast<std::size_t>(i)])) << i;
    }
    EXPECT_EQ(mode("octatonic-half-whole", 1), notes("octatonic-whole-half"));
    EXPECT_EQ(mode("in-sen", 0), notes("raga-revati"));
}

TEST(Scales, OfMessiaenCanBeTransposedFewTimes) {
    const std::map<std::string, std::size_t> transpositions = {
        {"whole-tone", 2}, {"octatonic-half-whole", 3}, {"messiaen-3", 4}, {"messiaen-4", 6},
        {"messiaen-5", 6}, {"messiaen-6", 6},           {"messiaen-7", 6}, {"major", 12},
    };
    for (const auto& [name, count] : transpositions) {
        std::set<std::set<int>> different;
        for (int by = 0; by < 12; ++by) {
            std::set<int> notes;
            for (const int degree : degrees(scale_of(name).ascent)) notes.insert((degree + by) % 12);
            different.insert(notes);
        }
        EXPECT_EQ(different.size(), count) << name;
    }
}

TEST(Scales, HaveTheMaqamatInQuarterTones) {
    for (const auto& [id, steps] : quarter_tone) {
        const Scale& scale = scale_of(id);
        EXPECT_EQ(scale.id, id);
        EXPECT_EQ(degrees(scale.ascent, 24), from_steps(steps, 24)) << id;
        const Scale* descent = find_scale(scale.id + "-desc");
        EXPECT_EQ(scale.descent, descent ? descent->ascent : scale.ascent) << id;
    }
    EXPECT_EQ(std::count_if(quarter_tone.begin(), quarter_tone.end(),
                            [](const Steps& row) { return std::string_view(row.first).ends_with("-desc"); }),
              5);
    EXPECT_EQ(id_of("rast"), "maqam-rast");
    EXPECT_EQ(id_of("Maqam Rast"), "maqam-rast");
    EXPECT_EQ(id_of("rastDesc"), "maqam-rast-desc");
    EXPECT_EQ(id_of("shawqAfza"), "maqam-shawq-afza");
    EXPECT_EQ(scale_of("rast").cents(2, false), 350.0);
    EXPECT_EQ(scale_of("rast").cents(6, false), 1050.0);
    EXPECT_EQ(scale_of("rast").cents(6, true), 1000.0);
}

TEST(Scales, HaveTheRagasInBothDirections) {
    struct Raga {
        const char* id;
        Keys up;
        Keys down;  // as it is sung
    };
    const std::vector<Raga> ragas = {
        {"raga-mohanam", {0, 2, 4, 7, 9}, {9, 7, 4, 2, 0}},
        {"raga-hamsadhwani", {0, 2, 4, 7, 11}, {11, 7, 4, 2, 0}},
        {"raga-hindolam", {0, 3, 5, 8, 10}, {10, 8, 5, 3, 0}},
        {"raga-abhogi", {0, 2, 3, 5, 9}, {9, 5, 3, 2, 0}},
        {"raga-suddha-saveri", {0, 2, 5, 7, 9}, {9, 7, 5, 2, 0}},
        {"raga-sriranjani", {0, 2, 3, 5, 9, 10}, {10, 9, 5, 3, 2, 0}},
        {"raga-madhyamavati", {0, 2, 5, 7, 10}, {10, 7, 5, 2, 0}},
        {"raga-sivaranjani", {0, 2, 3, 7, 9}, {9, 7, 3, 2, 0}},
        {"raga-revati", {0, 1, 5, 7, 10}, {10, 7, 5, 1, 0}},
        {"raga-malahari", {0, 1, 5, 7, 8}, {8, 7, 5, 4, 1, 0}},
        {"raga-bilahari", {0, 2, 4, 7, 9}, {11, 9, 7, 5, 4, 2, 0}},
        {"raga-abheri", {0, 3, 5, 7, 10}, {10, 9, 7, 5, 3, 2, 0}},
        {"raga-arabhi", {0, 2, 5, 7, 9}, {11, 9, 7, 5, 4, 2, 0}},
        {"raga-saveri", {0, 1, 5, 7, 8}, {11, 8, 7, 5, 4, 1, 0}},
        {"raga-kambhoji", {0, 2, 4, 5, 7, 9}, {10, 9, 7, 5, 4, 2, 0}},
        {"raga-mohanakalyani", {0, 2, 4, 7, 9}, {11, 9, 7, 6, 4, 2, 0}},
        {"carnatic-bhairavi", {0, 2, 3, 5, 7, 9, 10}, {10, 8, 7, 5, 3, 2, 0}},
        {"hindustani-bhairavi", {0, 1, 3, 5, 7, 8, 10}, {10, 8, 7, 5, 3, 1, 0}},
        {"hindustani-asavari", {0, 2, 5, 7, 8}, {10, 8, 7, 5, 3, 2, 0}},
        {"raga-marwa", {0, 1, 4, 6, 9, 11}, {11, 9, 6, 4, 1, 0}},
    };
    std::size_t count = 0;
    for (const Scale& scale : known_scales()) count += scale.group == "raga" ? 1 : 0;
    EXPECT_EQ(count, ragas.size());
    const auto parents = melakarta();
    for (const Raga& raga : ragas) {
        const Scale& scale = scale_of(raga.id);
        EXPECT_EQ(scale.id, raga.id);
        EXPECT_EQ(degrees(scale.ascent), raga.up) << raga.id;
        EXPECT_EQ(degrees(scale.descent), Keys(raga.down.rbegin(), raga.down.rend())) << raga.id;
        // A raga takes its notes from its parent; bhasanga ragas, as bhairavi, borrow some.
        const std::size_t mela = scale.sources.find("of mela ");
        if (mela == std::string::npos || scale.id == "carnatic-bhairavi") continue;
        const auto& parent = parents[static_cast<std::size_t>(std::stoi(scale.sources.substr(mela + 8)) - 1)];
        for (const Keys& notes : {raga.up, raga.down}) {
            for (const int note : notes) EXPECT_TRUE(std::count(parent.begin(), parent.end(), note)) << raga.id;
        }
    }
}

TEST(Scales, BeginAtTheTonicAndRiseWithinTheirPeriod) {
    for (const Scale& scale : known_scales()) {
        EXPECT_GT(scale.period, 0.0);
        EXPECT_FALSE(scale.title.empty()) << scale.id;
        EXPECT_FALSE(scale.group.empty()) << scale.id;
        EXPECT_FALSE(scale.sources.empty()) << scale.id;
        for (const auto* notes : {&scale.ascent, &scale.descent}) {
            ASSERT_FALSE(notes->empty()) << scale.id;
            EXPECT_EQ(notes->front(), 0.0) << scale.id;
            EXPECT_TRUE(std::is_sorted(notes->begin(), notes->end(), std::less_equal<>())) << scale.id;
            EXPECT_LT(notes->back(), scale.period) << scale.id;
        }
        EXPECT_EQ(scale.size(), std::max(scale.ascent.size(), scale.descent.size()));
        // Degrees rise in both directions, whatever they leave out, and close at the period.
        const auto size = static_cast<std::int64_t>(scale.size());
        for (const bool falling : {false, true}) {
            EXPECT_EQ(scale.cents(0, falling), 0.0) << scale.id;
            EXPECT_NEAR(scale.cents(size, falling), scale.period, 1e-9) << scale.id;
            EXPECT_NEAR(scale.cents(-3 * size, falling), -3 * scale.period, 1e-9) << scale.id;
            for (std::int64_t i = -20; i < 20; ++i) {
                EXPECT_LE(scale.cents(i, falling), scale.cents(i + 1, falling)) << scale.id << " " << i;
                EXPECT_NEAR(scale.cents(i + size, falling) - scale.cents(i, falling), scale.period, 1e-6);
            }
        }
    }
}

TEST(Scales, OfOtherTuningsAreWhatTheyAreCalled) {
    const auto ratio = [](double value) { return 1200.0 * std::log2(value); };
    EXPECT_NEAR(scale_of("bohlen-pierce").period, 1901.9550008653874, 1e-9);
    EXPECT_NEAR(scale_of("bohlen-pierce").cents(1, false), 146.30423083579903, 1e-9);
    EXPECT_NEAR(scale_of("bohlen-pierce").cents(26, false), 2 * 1901.9550008653874, 1e-9);
    EXPECT_EQ(scale_of("bohlen-pierce-lambda").size(), 9U);
    // Each note of the equal one is near to one of the just.
    for (int i = 0; i < 13; ++i) {
        EXPECT_NEAR(scale_of("bohlen-pierce-just").cents(i, false), scale_of("bohlen-pierce").cents(i, false), 17.0);
    }
    EXPECT_EQ(scale_of("22-shruti").size(), 22U);
    EXPECT_NEAR(scale_of("22 shruti").cents(1, false), 90.225, 0.001);
    EXPECT_NEAR(scale_of("just-major").cents(2, false), 386.314, 0.001);
    EXPECT_NEAR(scale_of("just-minor").cents(2, false), 315.641, 0.001);
    EXPECT_NEAR(scale_of("harmonics-8-16").cents(3, false), 551.318, 0.001);
    EXPECT_EQ(scale_of("slendro-like").cents(1, false), 240.0);
    EXPECT_EQ(scale_of("carlos-alpha").cents(9, false), 702.0);
    // Chains of fifths: pure ones, and those whose fours make 5/1.
    for (const auto& [name, fifth, first, last] :
         {std::tuple{"pythagorean", ratio(1.5), -5, 6}, std::tuple{"pythagorean-major", ratio(1.5), -1, 5},
          std::tuple{"quarter-comma-meantone", ratio(5.0) / 4, -3, 8},
          std::tuple{"meantone-major", ratio(5.0) / 4, -1, 5}}) {
        std::vector<double> chain;
        for (int i = first; i <= last; ++i) chain.push_back(i * fifth - 1200.0 * std::floor(i * fifth / 1200.0));
        std::sort(chain.begin(), chain.end());
        const Scale& scale = scale_of(name);
        ASSERT_EQ(scale.ascent.size(), chain.size()) << name;
        for (std::size_t i = 0; i < chain.size(); ++i) EXPECT_NEAR(scale.ascent[i], chain[i], 0.0006) << name;
    }
    // Major is seven fifths of any equal division: 11 of 19, 18 of 31, 31 of 53, 7 of 12.
    for (const auto& [name, division, fifth] :
         {std::tuple{"19-equal-major", 19, 11}, std::tuple{"31-equal-major", 31, 18},
          std::tuple{"53-equal-major", 53, 31}, std::tuple{"major", 12, 7}}) {
        Keys chain;
        for (int i = -1; i <= 5; ++i) chain.push_back((i * fifth % division + division) % division);
        std::sort(chain.begin(), chain.end());
        EXPECT_EQ(degrees(scale_of(name).ascent, division), chain) << name;
    }
}

TEST(Melakarta, AreTheSeventyTwo) {
    const auto expected = melakarta();
    ASSERT_EQ(expected.size(), 72U);
    std::set<std::vector<double>> different;
    for (int n = 1; n <= 72; ++n) {
        const Scale& scale = scale_of("mela-" + std::to_string(n));
        EXPECT_EQ(scale.id, "mela-" + std::to_string(n));
        EXPECT_EQ(scale.group, "melakarta");
        EXPECT_EQ(degrees(scale.ascent), expected[static_cast<std::size_t>(n - 1)]) << n;
        EXPECT_EQ(scale.descent, scale.ascent);
        EXPECT_EQ(&scale_of(scale.title), &scale) << scale.title;
        // The second half is the first one with the raised fourth.
        if (n > 36) {
            std::vector<double> pure = scale.ascent;
            pure[3] = 500.0;
            EXPECT_EQ(pure, scale_of("mela" + std::to_string(n - 36)).ascent);
        }
        different.insert(scale.ascent);
    }
    EXPECT_EQ(different.size(), 72U);
    EXPECT_EQ(known_scales().back().id, "mela-72");
    EXPECT_EQ(known_scales()[known_scales().size() - 72].id, "mela-1");
}

TEST(Melakarta, AreKnownElsewhereByOtherNames) {
    const std::vector<std::tuple<int, const char*, const char*>> same = {
        {8, "Hanumatodi", "phrygian"},
        {15, "Mayamalavagowla", "double-harmonic"},
        {29, "Dheerasankarabharanam", "major"},
        {65, "Mechakalyani", "lydian"},
        {20, "Natabhairavi", "minor"},
        {21, "Keeravani", "harmonic-minor"},
        {22, "Kharaharapriya", "dorian"},
        {28, "Harikambhoji", "mixolydian"},
        {23, "Gourimanohari", "jazz-minor"},
        {27, "Sarasangi", "harmonic-major"},
        {26, "Charukesi", "melodic-major"},
        {14, "Vakulabharanam", "phrygian-dominant"},
        {57, "Simhendramadhyamam", "hungarian-minor"},
        {70, "Nasikabhushani", "hungarian-major"},
        {58, "Hemavati", "romanian-minor"},
        {9, "Dhenuka", "neapolitan-minor"},
        {11, "Kokilapriya", "neapolitan-major"},
        {64, "Vachaspati", "lydian-dominant"},
        {62, "Rishabhapriya", "lydian-minor"},
        {45, "Subhapantuvarali", "todi-that"},
        {51, "Kamavardhini", "purvi-that"},
        {53, "Gamanashrama", "marva-that"},
        {16, "Chakravakam", "ahir-bhairav"},
    };
    for (const auto& [n, name, western] : same) {
        EXPECT_EQ(id_of(name), "mela-" + std::to_string(n));
        EXPECT_EQ(scale_of(name).ascent, scale_of(western).ascent) << name;
        // The data file tells the same.
        EXPECT_TRUE(has(scale_of(western).sources + ";", "mela " + std::to_string(n) + ";")) << western;
    }
}

TEST(Melakarta, AreFoundInManySpellings) {
    for (const char* name : {"mela 29", "mela-29", "Melakarta 29", "MELAKARTA29", "mela_029", "Shankarabharanam",
                             "Dhirasankarabharanam", "dhīraśaṅkarābharaṇaṃ", "Dheera Sankarabharanam"}) {
        EXPECT_EQ(id_of(name), "mela-29") << name;
    }
    for (const auto& [name, n] :
         {std::pair{"Kiravani", 21}, std::pair{"Keervani", 0}, std::pair{"Gaurimanohari", 23},
          std::pair{"Gowri manohari", 23}, std::pair{"Charukeshi", 26}, std::pair{"Kharaharapriyā", 22},
          std::pair{"kalyani", 65}, std::pair{"Raga Kalyani", 65}, std::pair{"Kalyāṇī", 65},
          std::pair{"Mayamalavagaula", 15}, std::pair{"Māyāmāḷavagauḷa", 15}, std::pair{"Shubhapantuvarali", 45},
          std::pair{"Pantuvarali", 51}, std::pair{"Vagadhishvari", 34}, std::pair{"Nitimati", 60},
          std::pair{"Jhankaradhvani", 19}, std::pair{"Navaneetham", 40}, std::pair{"carnatic todi", 8}}) {
        EXPECT_EQ(id_of(name), n ? "mela-" + std::to_string(n) : "none") << name;
    }
    for (const char* name : {"mela 0", "mela 73", "mela", "mela 1.5", "mela 1 2x", "mela 99999999999999999999"}) {
        EXPECT_FALSE(find_scale(name)) << name;
    }
    EXPECT_EQ(id_of("mela 1 2"), "mela-12");  // blanks do not matter
}

TEST(ScaleNames, LeadToOneScaleEach) {
    std::set<std::string> ids;
    for (const Scale& scale : known_scales()) {
        EXPECT_TRUE(ids.insert(scale.id).second) << scale.id;
        EXPECT_EQ(find_scale(scale.id), &scale) << scale.id;
        for (const std::string& name : scale.names) EXPECT_EQ(find_scale(name), &scale) << name;
        for (const char byte : scale.id) {
            EXPECT_TRUE((byte >= 'a' && byte <= 'z') || (byte >= '0' && byte <= '9') || byte == '-') << scale.id;
        }
        std::string loud;
        for (const char byte : scale.id) {
            loud += byte == '-' ? ' ' : byte >= 'a' && byte <= 'z' ? static_cast<char>(byte - 'a' + 'A') : byte;
        }
        EXPECT_EQ(find_scale(loud), &scale) << loud;
    }
}

TEST(ScaleNames, EqualDivisionsOfTheOctave) {
    for (const char* name : {"31-edo", "31-equal", "31 EDO", "31tet"}) {
        const Scale* scale = find_scale(name);
        ASSERT_TRUE(scale) << name;
        EXPECT_EQ(scale->size(), 31u);
        EXPECT_NEAR(scale->cents(18, false), 1200.0 * 18 / 31, 1e-9);
        EXPECT_NEAR(scale->cents(-31, true), -1200.0, 1e-9);
        EXPECT_EQ(find_scale("31-edo"), scale);
    }
    EXPECT_EQ(id_of("19-edo"), "19-equal");  // as listed
    EXPECT_EQ(find_scale("1200-edo")->size(), 1200u);
    EXPECT_EQ(find_scale("1-edo")->size(), 1u);
    for (const char* name : {"0-edo", "1201-edo", "-edo", "3.5-edo", "99999999999-edo", "31-edo-x"}) {
        EXPECT_FALSE(find_scale(name)) << name;
    }
    // A sign is no hyphen between words, also before names that are listed, and a number has no hyphen in it.
    for (const char* name : {"-5-edo", "- 31-edo", "--7-equal", "\u20135-edo", "-19-equal-major", "3-1-edo"}) {
        EXPECT_FALSE(find_scale(name)) << name;
    }
    for (const char* name : {"0-edo", "1201-edo", "99999999999999999999-edo"}) {
        EXPECT_TRUE(has(unknown_scale(name), "1 to 1200 equal steps")) << name;
    }
    EXPECT_EQ(unknown_scale("-5-edo"), "unknown scale '-5-edo'; did you mean '5-edo'?");
    EXPECT_EQ(unknown_scale("-31-edo"), "unknown scale '-31-edo'; did you mean '31-edo'?");
}

TEST(ScaleNames, ASignBeforeEqualStepsIsRefusedAtItsPlace) {
    Diagnostics diagnostics;
    read_melody(parse_pattern("a.lsys", "axiom: F\nscale: -5-edo\n", diagnostics), {}, diagnostics);
    ASSERT_EQ(diagnostics.list().size(), 1U);
    EXPECT_EQ(diagnostics.list().front().message, "unknown scale '-5-edo'; did you mean '5-edo'?");
    EXPECT_EQ(diagnostics.list().front().where, (Place{2, 8}));
}

TEST(ScaleNames, DoNotMindCaseBlanksAndAccents) {
    for (const char* name : {"harmonic-minor", "harmonicMinor", "harmonic_minor", "Harmonic Minor",
                             " harmonic  minor ", "HARMONIC-MINOR", "hármônic mïnör", "h\u0061\u0301rmonic minor"}) {
        EXPECT_EQ(id_of(name), "harmonic-minor") << name;
    }
    // As the programs write them.
    for (const auto& [name, id] : {std::pair{"superLocrian", "altered"},
                                   std::pair{"super_locrian", "altered"},
                                   std::pair{"majPent", "major-pentatonic"},
                                   std::pair{"melodic_minor_asc", "jazz-minor"},
                                   std::pair{"melodicMinorDesc", "minor"},
                                   std::pair{"whole", "whole-tone"},
                                   std::pair{"messiaen's mode #3", "messiaen-3"},
                                   std::pair{"messiaen3", "messiaen-3"},
                                   std::pair{"messiaen2", "octatonic-half-whole"},
                                   std::pair{"dorian #4", "romanian-minor"},
                                   std::pair{"dorian ♯4", "romanian-minor"},
                                   std::pair{"lydian b7", "lydian-dominant"},
                                   std::pair{"lydian ♭7", "lydian-dominant"},
                                   std::pair{"chromatic24", "chromatic-24"},
                                   std::pair{"blues_minor", "blues"},
                                   std::pair{"half-whole diminished", "octatonic-half-whole"},
                                   std::pair{"whole-half diminished", "octatonic-whole-half"},
                                   std::pair{"malkauns", "raga-hindolam"},
                                   std::pair{"Bilahari", "raga-bilahari"},
                                   std::pair{"rāga bilahari", "raga-bilahari"},
                                   std::pair{"Mohana", "raga-mohanam"},
                                   std::pair{"Shivaranjani", "raga-sivaranjani"},
                                   std::pair{"prometheus", "prometheus"},
                                   std::pair{"scriabin", "scriabin"}}) {
        EXPECT_EQ(id_of(name), id) << name;
    }
    for (const char* name : {"", " ", "-", "nothing at all", "\xFF\xFE", "minorr", "raga", "maqam", "\u266F"}) {
        EXPECT_FALSE(find_scale(name)) << name;
    }
    EXPECT_FALSE(find_scale(std::string(1'000'000, 'a')));
    EXPECT_FALSE(find_scale(std::string_view("major\0", 6)));
}

TEST(ScaleNames, ThatMeanSeveralFindNoneAndAreToldApart) {
    const std::map<std::string, std::vector<std::string>> meanings = {
        {"diminished", {"octatonic-half-whole", "octatonic-whole-half"}},
        {"octatonic", {"octatonic-half-whole", "octatonic-whole-half"}},
        {"Todi", {"todi-that", "mela-8"}},
        {"Bhairavi", {"carnatic-bhairavi", "hindustani-bhairavi"}},
        {"raga-bhairavi", {"carnatic-bhairavi", "hindustani-bhairavi"}},
        {"Bhairavee", {}},
        {"marva", {"marva-that", "raga-marwa"}},
        {"Marwa", {"marva-that", "raga-marwa"}},
        {"gypsy", {"double-harmonic", "hungarian-minor"}},
        {"arabian", {"double-harmonic", "locrian-major"}},
        {"asavari", {"hindustani-asavari", "minor"}},
    };
    for (const auto& [word, ids] : meanings) {
        EXPECT_FALSE(find_scale(word)) << word;
        EXPECT_TRUE(ids.empty() || similar_scales(word) == ids) << word;
        for (const std::string& id : ids) EXPECT_EQ(id_of(id), id);
    }
    EXPECT_EQ(id_of("todi-that"), "todi-that");
    EXPECT_EQ(id_of("raga-marwa"), "raga-marwa");
    // The two scales of that name: Scriabin's six notes, and what three programs have.
    EXPECT_EQ(degrees(scale_of("prometheus").ascent), (Keys{0, 2, 4, 6, 9, 10}));
    EXPECT_EQ(degrees(scale_of("prometheus-supercollider").ascent), (Keys{0, 2, 4, 6, 11}));
    EXPECT_TRUE(has(scale_of("prometheus").sources, "prometheus-supercollider"));
}

TEST(ScaleNames, ThatAreMissedHaveNeighbours) {
    EXPECT_EQ(similar_scales("dorain").front(), "dorian");
    EXPECT_EQ(similar_scales("Frygian").front(), "phrygian");
    EXPECT_EQ(similar_scales("mixolidian").front(), "mixolydian");
    EXPECT_EQ(similar_scales("ioniann").front(), "ionian");
    EXPECT_EQ(similar_scales("bilhari").front(), "Bilahari");
    EXPECT_EQ(similar_scales("mechakalyanni").front(), "Mechakalyani");
    for (const char* word : {"messiaen", "mela", "x", "pentatonik", "harmonic", "", "raga"}) {
        const auto found = similar_scales(word);
        EXPECT_LE(found.size(), 3U) << word;
        for (const std::string& name : found) EXPECT_TRUE(find_scale(name)) << name;
    }
    EXPECT_EQ(similar_scales("harmonic").size(), 3U);
    EXPECT_TRUE(similar_scales("wholly-unlike-everything").empty());
    EXPECT_TRUE(similar_scales(std::string(100'000, 'q')).empty());
    EXPECT_TRUE(similar_scales("\xFF\xC0").size() <= 3);
}

TEST(Degrees, GoThroughTheOctavesByFloorDivision) {
    const Scale& major = scale_of("major");
    EXPECT_EQ(sounding(major, -8, 8, false), (Keys{-13, -12, -10, -8, -7, -5, -3, -1, 0, 2, 4, 5, 7, 9, 11, 12, 14}));
    EXPECT_EQ(sounding(major, -8, 8, true), sounding(major, -8, 8, false));
    EXPECT_EQ(major.cents(7'000'000'000, false), 1.2e12);
    EXPECT_EQ(major.cents(-7'000'000'001, false), -1.2e12 - 100.0);
}

TEST(Degrees, OfMelodicMinorAreTheSameStepInBothDirections) {
    const Scale& scale = scale_of("melodic-minor");
    EXPECT_EQ(scale.size(), 7U);
    EXPECT_EQ(sounding(scale, -2, 8, false), (Keys{-3, -1, 0, 2, 3, 5, 7, 9, 11, 12, 14}));
    EXPECT_EQ(sounding(scale, -2, 8, true), (Keys{-4, -2, 0, 2, 3, 5, 7, 8, 10, 12, 14}));
}

TEST(Degrees, LeftOutByOneDirectionGoOnToItsNext) {
    // Up S R G P D, down S N D P M G R S: the fourth goes up to the fifth, the seventh to the tonic.
    const Scale& bilahari = scale_of("bilahari");
    EXPECT_EQ(bilahari.size(), 7U);
    EXPECT_EQ(sounding(bilahari, -7, 7, true), (Keys{-12, -10, -8, -7, -5, -3, -1, 0, 2, 4, 5, 7, 9, 11, 12}));
    EXPECT_EQ(sounding(bilahari, -7, 7, false), (Keys{-12, -10, -8, -5, -5, -3, 0, 0, 2, 4, 7, 7, 9, 12, 12}));
    // Six and seven notes.
    EXPECT_EQ(sounding(scale_of("kambhoji"), -1, 7, false), (Keys{0, 0, 2, 4, 5, 7, 9, 12, 12}));
    EXPECT_EQ(sounding(scale_of("kambhoji"), -1, 7, true), (Keys{-2, 0, 2, 4, 5, 7, 9, 10, 12}));
    // Abheri leaves out the second and the sixth.
    EXPECT_EQ(sounding(scale_of("abheri"), 0, 7, false), (Keys{0, 3, 3, 5, 7, 10, 10, 12}));

    // The other way round: a descent with fewer notes goes down to its next.
    Scale scale;
    scale.ascent = {0, 200, 400, 500, 700, 900, 1100};
    scale.descent = {0, 300, 700};
    EXPECT_EQ(scale.size(), 7U);
    EXPECT_EQ(sounding(scale, -2, 7, true), (Keys{-5, -5, 0, 0, 3, 3, 7, 7, 7, 12}));
    EXPECT_EQ(sounding(scale, 0, 7, false), (Keys{0, 2, 4, 5, 7, 9, 11, 12}));
    // A note of the one that the other lacks may also lie below its lowest within the period.
    scale.descent = {100, 300};
    EXPECT_EQ(sounding(scale, 0, 2, true), (Keys{-9, 1, 3}));
}

TEST(Degrees, NeedNeitherAnOctaveNorOrder) {
    Scale scale;
    scale.ascent = scale.descent = {0, 500, -20, 300};
    scale.period = 1900;
    EXPECT_EQ(scale.cents(1, false), 500.0);
    EXPECT_EQ(scale.cents(2, true), -20.0);
    EXPECT_EQ(scale.cents(-1, false), 300.0 - 1900.0);
    EXPECT_EQ(scale.cents(6, false), -20.0 + 1900.0);
    scale.period = -100;
    EXPECT_EQ(scale.cents(4, false), -100.0);
    EXPECT_EQ(scale.cents(-4, false), 100.0);
    // Made by hand and half empty.
    Scale bare;
    EXPECT_EQ(bare.size(), 1U);
    EXPECT_EQ(bare.cents(-2, true), -2400.0);
    bare.ascent = {0, 700};
    EXPECT_EQ(bare.cents(3, true), 1900.0);
}

TEST(ScalesCommand, ListsThemInGroups) {
    const Outcome all = run({"scales"});
    EXPECT_EQ(all.status, 0) << all.errors;
    EXPECT_TRUE(has(all.output, "western\n  major "));
    EXPECT_TRUE(has(all.output, "\n\nmelakarta\n  mela-1 "));
    EXPECT_TRUE(has(all.output, "ionian"));
    EXPECT_TRUE(has(all.output, "  raga-bilahari              5/7\n"));
    const auto lines = static_cast<std::size_t>(std::count(all.output.begin(), all.output.end(), '\n'));
    EXPECT_GT(lines, known_scales().size());
    for (const Scale& scale : known_scales()) EXPECT_TRUE(has(all.output, "\n  " + scale.id + " "));

    const Outcome group = run({"scales", "Pentatonic"});
    EXPECT_TRUE(has(group.output, "pentatonic\n  major-pentatonic "));
    EXPECT_FALSE(has(group.output, "western"));
}

TEST(ScalesCommand, ShowsOne) {
    EXPECT_EQ(run({"scales", "harmonic", "minor", "--tonic", "D"}).output,
              "Harmonic minor (harmonic-minor, western)\n"
              "notes    7\n"
              "steps    2 1 2 2 1 3 1\n"
              "on D     D E F G A Bb C#\n"
              "cents    0 200 300 500 700 800 1100\n"
              "period   1200 cents\n"
              "sources  SuperCollider, Tidal, Sonic Pi, tonal; mela 21\n");
    const std::string bilahari = run({"scales", "bilahari"}).output;
    EXPECT_TRUE(has(bilahari, "notes    5 rising, 7 falling\nrising\nsteps    2 2 3 2 3\non C     C D E G A\n"));
    EXPECT_TRUE(has(bilahari, "falling\nsteps    2 2 1 2 2 2 1\non C     C D E F G A B\n"));
    EXPECT_TRUE(has(run({"scales", "mela", "29"}).output, "Dheerasankarabharanam (mela-29, melakarta)\n"));
    EXPECT_TRUE(has(run({"scales", "19-equal-major"}).output, "steps    3 3 2 3 3 3 2, of 19 to the period\n"));
    EXPECT_TRUE(has(run({"scales", "just-major"}).output, "on C     C D+4 E-14 F-2 G+2 A-16 B-12\n"));
    EXPECT_TRUE(has(run({"scales", "bohlen-pierce"}).output, "period   1901.955 cents\n"));
}

TEST(ScalesCommand, LooksForWords) {
    const Outcome tonal = run({"scales", "sonic pi", "octatonic"});
    EXPECT_EQ(tonal.status, 0);
    EXPECT_TRUE(has(tonal.output, "octatonic-whole-half"));
    EXPECT_FALSE(has(tonal.output, "major"));
    for (const char* word : {"diminished", "octatonic", "todi", "bhairavi", "marva", "marwa", "gypsy", "arabian",
                             "arabic", "asavari", "asawari"}) {
        const Outcome found = run({"scales", word});
        EXPECT_EQ(found.status, 0) << word;
        ASSERT_GE(similar_scales(word).size(), 2U) << word;
        for (const std::string& id : similar_scales(word)) EXPECT_TRUE(has(found.output, "  " + id + " ")) << word;
    }
    const Outcome missed = run({"scales", "dorain"});
    EXPECT_EQ(missed.status, 2);
    EXPECT_EQ(missed.output, "");
    EXPECT_TRUE(has(missed.errors, "unknown scale 'dorain'; did you mean 'dorian'"));
    EXPECT_TRUE(has(run({"scales", "wholly unlike"}).errors, "`sikku scales` lists the bundled scales"));
    EXPECT_TRUE(has(run({"scales", "major", "--tonic", "H"}).errors, "--tonic H"));
}

TEST(ScalesCommand, WritesJson) {
    EXPECT_EQ(run({"scales", "melodic", "minor", "--json"}).output,
              "[{\"id\": \"melodic-minor\", \"title\": \"Melodic minor\", \"group\": \"western\", \"size\": 7, "
              "\"ascent\": [0, 200, 300, 500, 700, 900, 1100], \"descent\": [0, 200, 300, 500, 700, 800, 1000], "
              "\"period\": 1200, \"names\": [], \"sources\": \"" +
                  scale_of("melodic-minor").sources + "\"}]\n");
    const Outcome all = run({"scales", "--json"});
    EXPECT_EQ(static_cast<std::size_t>(std::count(all.output.begin(), all.output.end(), '\n')),
              known_scales().size());
    EXPECT_TRUE(all.output.starts_with("[{") && all.output.ends_with("}]\n"));
}

TEST(ScalesCommand, ShowsScalaFiles) {
    const ScratchFolder folder;
    const std::string good = folder.write("My scale.SCL", "! x\nFour notes\n 4\n 9/8\n 386.3 third\n 3/2\n 2/1\n");
    EXPECT_EQ(run({"scales", good}).output,
              "Four notes (My scale, scala)\n"
              "notes    4\n"
              "steps    203.91 182.39 315.655 498.045 cents\n"
              "on C     C D+4 E-14 G+2\n"
              "cents    0 203.91 386.3 701.955\n"
              "period   1200 cents\n"
              "sources  " +
                  good + "\n");
    const std::string bad = folder.write("bad.scl", "! x\nFour notes\n 4\n 9/8\n what\n 3/2\n 2/1\n");
    const Outcome outcome = run({"scales", bad});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_TRUE(has(outcome.errors, "bad.scl:5:2: 'what' is neither cents"));
    const Outcome none = run({"scales", folder.file("none.scl")});
    EXPECT_EQ(none.status, 2);
    EXPECT_TRUE(has(none.errors, "none.scl: No such file or directory"));
}

}  // namespace sikku::scale_test
