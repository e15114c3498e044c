// music/scores.h: scores of documents: the public interface of music.
#pragma once

#include "engine/interpreter.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace sikku {

/// Plays documents: MIDI, MusicXML, LilyPond, WAV, FLAC, an SVG of the notes, and a page that plays.
const Interpreter& scores();

/// Returns the bytes of a score. Names in `values` are options of scores() or keys and defines of the pattern:
/// `play(koch, "mid", {{"scale", "dorian"}, {"bars", "16"}})`.
/// @param format  a name from scores().formats()
/// @throws SettingError, PatternError, BudgetError, WordError, ScoreError
std::string play(const Document& document, std::string_view format, const OptionValues& values = {});

/// Plans a score with a part for each document; the first one sets tempo and meter.
/// @param folder  folder of files that `values` name
std::unique_ptr<Work> plan_score(std::span<const Document> documents, std::string_view format,
                                 const OptionValues& values, const std::filesystem::path& folder = {});

/// Describes the music without writing a score: notes, bars, time and range, in a block of lines for each document.
std::string describe_score(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor);

}  // namespace sikku
