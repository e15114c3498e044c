// music/scores.h: scores of documents: the public interface of music.
#pragma once

#include "engine/interpreter.h"
#include "music/score/score.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Plays documents: MIDI, MusicXML, LilyPond, WAV, FLAC, an SVG of the notes, and a page that plays.
const Interpreter& scores();

/// Extensions of files for messages, such as `.mid`: those that need no other program come first.
struct ScoreExtensions {
    std::vector<std::string> scores;
    std::vector<std::string> sounds;
    std::vector<std::string> views;  ///< pictures and pages of the notes
};
ScoreExtensions score_extensions();

/// Returns the bytes of a score. Names in `values` are options of scores() or keys and defines of the pattern:
/// `play(koch, "mid", {{"scale", "dorian"}, {"bars", "16"}})`.
/// @param format  a name from scores().formats()
/// @throws SettingError, PatternError, BudgetError, WordError, ScoreError
std::string play(const Document& document, std::string_view format, const OptionValues& values = {},
                 const Monitor& monitor = {});

/// Plans a score with a part for each document; the first one sets tempo and meter.
/// @param folder  folder of files that `values` name
std::unique_ptr<Work> plan_score(std::span<const Document> documents, std::string_view format,
                                 const OptionValues& values, const std::filesystem::path& folder = {});

struct Arrangement;

/// Plans a score of an arrangement: see music/arrangement.h. @throws as make(); SettingError for formats that cannot
/// represent it
/// @param folder  folder of files that patterns and `values` name
std::unique_ptr<Work> plan_score(const Arrangement& arrangement, std::string_view format, const OptionValues& values,
                                 const std::filesystem::path& folder = {});

/// The notes of a score, with its meter and tempo.
struct NoteList {
    std::vector<Note> notes;  ///< by onset, then by voice
    std::int64_t end = 0;     ///< end of the score in ticks, rests included
    double tempo = 120.0;     ///< quarter notes per minute
    Meter meter;
    std::int64_t upbeat = 0;             ///< ticks before the first bar line; 0: it begins at a bar line
    std::vector<SectionChange> changes;  ///< of tempo and meter after the beginning
    std::vector<Part> parts;
};

/// Lists the notes of a score with a part for each document. @throws as Work::make(); ScoreError if the notes would
/// take more than a quarter of the memory
NoteList list_notes(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor);

NoteList list_notes(const Arrangement& arrangement, const OptionValues& values, const Monitor& monitor);

/// Describes the music without writing a score: notes, bars, time and range, in a block of lines for each document.
std::string describe_score(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor);
/// Describes the music of each track and of all together.
std::string describe_score(const Arrangement& arrangement, const OptionValues& values, const Monitor& monitor,
                           const std::filesystem::path& folder = {});

}  // namespace sikku
