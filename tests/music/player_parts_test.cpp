// Parts of players: their notes, gathered rests, cues; keyboards of several voices.
#include "music/score/player_parts.h"

#include "music/score/score_formats.h"
#include "tests/notation_tools.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku {
namespace {

constexpr std::int64_t bar = 4 * ticks_per_quarter;

/// Adds notes of a quarter each from a bar on.
void add_quarters(TestScore& score, std::int16_t voice, std::int64_t first_bar, const std::vector<double>& keys) {
    std::int64_t onset = first_bar * bar;
    for (const double key : keys) {
        score.notes.push_back({.onset = onset, .duration = ticks_per_quarter, .key = key, .voice = voice});
        onset += ticks_per_quarter;
    }
    score.end = std::max(score.end, (onset + bar - 1) / bar * bar);
}

Part instrument(const std::string& name, int program) {
    Part part = plain_part(name, 1);
    part.program = program;
    part.has_instrument_name = true;
    return part;
}

constexpr int flute = 73, clarinet = 71, tuba = 58, organ = 19, harpsichord = 6;

/// A flute that plays in all of ten bars, and a second instrument that enters in the last.
TestScore with_entry(int program) {
    TestScore score;
    score.head.is_transposed = true;
    score.head.parts = {instrument("Flute", flute), instrument("Other", program)};
    for (int i = 0; i < 10; ++i) add_quarters(score, 0, i, {72.0 + i % 4, 74, 76, 77});
    add_quarters(score, 1, 9, {60, 62, 64, 65});
    return score;
}

std::vector<double> keys_of(const NotatedVoice& voice) {
    std::vector<double> keys;
    for (const NotatedSymbol& symbol : voice.symbols) {
        if (symbol.kind == SymbolKind::note) keys.push_back(symbol.pitch.key());
    }
    return keys;
}

TEST(PlayerParts, CuesAreWrittenForTheirReader) {
    const std::vector<PlayerPart> players = player_parts(notate(with_entry(clarinet)));
    ASSERT_EQ(players.size(), 2u);
    EXPECT_TRUE(players[0].notation.parts[0].staves[0].cues.empty());
    const Staff& staff = players[1].notation.parts[0].staves[0];
    ASSERT_EQ(staff.cues.size(), 1u);
    const Cue& cue = staff.cues.front();
    EXPECT_EQ(cue.name, "Fl.");
    EXPECT_EQ(cue.from, 7 * bar);
    EXPECT_EQ(cue.to, 9 * bar);
    // A clarinet is written a whole tone higher.
    EXPECT_EQ(keys_of(cue.voice), (std::vector<double>{77, 76, 78, 79, 74, 76, 78, 79}));
    EXPECT_EQ(players[1].notation.gathered_rests, (std::map<std::int64_t, std::int64_t>{{0, 7}}));
}

TEST(PlayerParts, CuesStandOnTheStaff) {
    const std::vector<PlayerPart> players = player_parts(notate(with_entry(tuba)));
    const Staff& staff = players[1].notation.parts[0].staves[0];
    ASSERT_EQ(staff.cues.size(), 1u);
    const int middle = middle_line(staff.changes.front().clef);
    for (const NotatedSymbol& symbol : staff.cues.front().voice.symbols) {
        EXPECT_LE(std::abs(symbol.pitch.height() - middle), 7);
    }
}

TEST(PlayerParts, ShortRestsDrumsAndOtherMediaHaveNoCues) {
    TestScore score = with_entry(clarinet);
    std::erase_if(score.notes, [](const Note& note) { return note.voice == 1; });
    add_quarters(score, 1, 7, {60});
    EXPECT_TRUE(player_parts(notate(score))[1].notation.parts[0].staves[0].cues.empty());
    TestScore drums = with_entry(0);
    drums.head.parts[1].is_drums = true;
    for (Note& note : drums.notes) {
        if (note.voice == 1) note.key = 38;
    }
    EXPECT_TRUE(player_parts(notate(drums))[1].notation.parts[0].staves[0].cues.empty());
    EXPECT_TRUE(player_parts(notate(with_entry(clarinet)), false)[1].notation.parts[0].staves[0].cues.empty());
}

TEST(PlayerParts, RandomScoresKeepTheirNotes) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Notation score = notate(random_score(seed, false));
        std::size_t at = 0;
        std::vector<std::vector<PlainNote>> expected;
        const auto notes_of = [](const NotatedVoice& voice) {
            std::vector<PlainNote> notes;
            for (const NotatedSymbol& symbol : voice.symbols) {
                if (symbol.kind == SymbolKind::note)
                    notes.push_back({symbol.onset, symbol.length, symbol.pitch.key()});
            }
            return notes;
        };
        each_voice(score, [&](const NotatedVoice& voice) { expected.push_back(notes_of(voice)); });
        for (const PlayerPart& player : player_parts(score)) {
            ASSERT_EQ(player.notation.parts.size(), 1u);
            each_voice(player.notation, [&](const NotatedVoice& voice) {
                ASSERT_LT(at, expected.size());
                EXPECT_EQ(notes_of(voice), expected[at++]) << seed;
                for (const NotatedSymbol& symbol : voice.symbols) {
                    for (const auto& [first, count] : player.notation.gathered_rests) {
                        const std::int64_t place = player.notation.bar_lines.number(symbol.onset);
                        if (place < first || place >= first + count) continue;
                        EXPECT_NE(symbol.kind, SymbolKind::note) << seed;
                        EXPECT_NE(symbol.kind, SymbolKind::rest) << seed;
                    }
                }
            });
        }
        EXPECT_EQ(at, expected.size());
    }
}

TEST(PlayerParts, SilentPartsRestThroughout) {
    TestScore score = with_entry(clarinet);
    std::erase_if(score.notes, [](const Note& note) { return note.voice == 1; });
    const std::vector<PlayerPart> players = player_parts(notate(score));
    EXPECT_EQ(players[1].notation.gathered_rests, (std::map<std::int64_t, std::int64_t>{{0, 10}}));
    MemorySink text;
    write_lilypond(players[1].notation, score.head, text);
    EXPECT_NE(text.text.find("R1*4/4*10 \\bar \"|.\""), std::string::npos);
}

TEST(PlayerParts, NamesOfFiles) {
    EXPECT_EQ(file_part("Tenor Sax"), "tenor-sax");
    EXPECT_EQ(file_part("Clarinet in B♭"), "clarinet-in-b♭");
    EXPECT_EQ(file_part("../etc: \"Bass\" 2"), "etc-bass-2");
    EXPECT_EQ(file_part(""), "part");
    EXPECT_EQ(file_part("///"), "part");
    EXPECT_EQ(file_part("\xff\xfe"), "part");
    EXPECT_LE(file_part(std::string(1000, 'x')).size(), 40u);
    EXPECT_EQ(file_part("வீணை"), "வீணை");
}

TEST(Keyboards, FourLinesOfAnOrganAreForHandsAndPedal) {
    TestScore score;
    for (int i = 0; i < 4; ++i) score.head.parts.push_back(instrument("Church Organ", organ));
    add_quarters(score, 0, 0, {79, 77, 76, 74});
    add_quarters(score, 1, 0, {67, 69, 67, 65});
    add_quarters(score, 2, 0, {60, 60, 55, 59});
    add_quarters(score, 3, 0, {48, 53, 48, 43});
    const Notation notation = notate(score);
    ASSERT_EQ(notation.parts.size(), 1u);
    const NotatedPart& part = notation.parts.front();
    ASSERT_EQ(part.staves.size(), 3u);
    EXPECT_TRUE(part.has_pedal);
    EXPECT_EQ(part.bracket, Bracket::brace);
    EXPECT_EQ(part.staves[2].voices.size(), 1u);
    EXPECT_EQ(part.staves[2].changes.front().clef, Clef::bass);
    EXPECT_EQ(keys_of(part.staves[2].voices.front()), (std::vector<double>{48, 53, 48, 43}));
    MemorySink xml, lilypond, abc;
    write_musicxml(notation, score.head, xml);
    EXPECT_NE(xml.text.find("<part-symbol top-staff=\"1\" bottom-staff=\"2\">brace</part-symbol>"),
              std::string::npos);
    write_lilypond(notation, score.head, lilypond);
    EXPECT_NE(lilypond.text.find("instrumentName = \"Pedal\""), std::string::npos);
    write_abc(notation, score.head, abc);
    EXPECT_NE(abc.text.find("%%score {1 (2 3)} 4"), std::string::npos) << abc.text;
    EXPECT_EQ(player_parts(notation).size(), 1u);
}

TEST(Keyboards, LinesWithoutPedalOrOfMorePlayers) {
    TestScore score;
    for (int i = 0; i < 3; ++i) score.head.parts.push_back(instrument("Harpsichord", harpsichord));
    for (std::int16_t i = 0; i < 3; ++i) add_quarters(score, i, 0, {72.0 - 12 * i, 74.0 - 12 * i});
    Notation notation = notate(score);
    ASSERT_EQ(notation.parts.size(), 1u);
    EXPECT_EQ(notation.parts.front().staves.size(), 2u);
    EXPECT_FALSE(notation.parts.front().has_pedal);
    // Notes above the pedal stay in the hands.
    for (Part& part : score.head.parts) part = instrument("Church Organ", organ);
    for (Note& note : score.notes) note.key += 24;
    notation = notate(score);
    EXPECT_FALSE(notation.parts.front().has_pedal);
    // Five lines are too many for one player.
    for (int i = 0; i < 2; ++i) score.head.parts.push_back(instrument("Church Organ", organ));
    add_quarters(score, 3, 0, {60});
    add_quarters(score, 4, 0, {61});
    EXPECT_EQ(notate(score).parts.size(), 5u);
}

}  // namespace
}  // namespace sikku
