// music/players.h: the parts of a score: documents with their melodies, and how they are played together.
#pragma once

#include "engine/base/input_file.h"
#include "engine/base/monitor.h"
#include "engine/language/document.h"
#include "music/melody/mapping.h"
#include "music/melody/melody.h"
#include "music/play_settings.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sikku {

/// Largest number of voices of a score.
constexpr int most_voices = 1000;

/// A pattern that is a part of the score.
struct Player {
    Document document;
    Melody melody;
    int first_voice = 0;
    int chords_from = 0;  ///< number of its voices before those of drone or chords
    int drums_from = 0;   ///< offset of the voices of drums
    bool has_drums = false;
    bool is_bass = false;                      ///< bass of the player before it: `harmony: bass`
    bool is_follower = false;                  ///< follows a player before it in canon
    char section = 0;                          ///< section of the score, `A` to `Z`; 0: it plays from the beginning
    std::string name;                          ///< name of its part; empty: that of the instrument
    Swing printed_swing{};                     ///< in print, which writes the notes straight
    Touch printed_touch{};                     ///< in print, which writes the notes in full
    std::vector<std::string> warnings;         ///< warnings about values of options
    std::shared_ptr<PlayableMelody> playable;  ///< prepared once for it and the players that follow it in canon

    /// Plays the part alone. @throws as PlayableMelody::play()
    PlayReport play(NoteSink& sink, const PlayOptions& options) const {
        return playable->play(melody, sink, options);
    }
};

/// Reads the melody of a document with the keys of `settings`. @param folder  folder of files that options name
/// @throws SettingError, PatternError; std::runtime_error if a file cannot be read
Player read_player(const PlaySettings& settings, const Document& given, const std::filesystem::path& folder,
                   const FileWitness& witness);

/// Reports phrases, forms, cadences and levels that cannot be played from the grammar of the pattern.
void check_phrases(const Pattern& pattern, const Grammar& grammar, Diagnostics& diagnostics);

/// True if only some bars of the melody are played.
bool has_excerpt(const Player& player);

/// Limits a piece, in ticks of the part, to the excerpt of the melody that is played.
void cut_excerpt(const Player& player, PlayOptions& options);

/// The voices that follow a player in canon.
std::vector<Player> followers_of(const Player& player);

/// The curve of a lower order in notes so long that it lasts as long as the melody. @throws ScoreError, SettingError
Player bass_of(const Player& player);

/// Number of voices that sound, counted by playing the part if brackets are voices.
int voices_of(const Player& player, const PlayOptions& playing);

/// The scale in words, with its tonic.
std::string scale_of(const Melody& melody);

/// The reason why a part has no notes, and a remedy; empty if unknown. @param lost  notes without a length or a key
std::string reason_of_silence(const Player& player, std::uint64_t lost);

/// Number of bars begun within a number of ticks.
Integer bars_of(const Integer& ticks, const Meter& meter);

/// Number of the bar in which a melody ends. @param ticks  of the melody, including the rest before an upbeat
Integer last_bar(const Integer& ticks, const Melody& melody);

/// Duration in words. @param tempo  quarters a minute
std::string time_of(const Integer& ticks, double tempo);

/// Lowest and highest note: `C4 to G5`.
std::string range_of(const PlayReport& report, const Melody& melody);

/// The symbols that a table leaves out, the most frequent first: `5 Y, 2 X`.
std::string skipped_text(const std::map<std::string, std::uint64_t>& skipped);

/// Plays a part alone.
using PlayAlone = std::function<PlayReport(const Player& player)>;

/// Describes the music without writing a score: by playing, or, if that would take too long, by the fold.
/// @param play_whole  plays parts that are read as a whole, in a form or reversed, for example
std::string description(const std::vector<Player>& players, const PlayOptions& piece, bool is_whole,
                        const PlayAlone& play_whole);

}  // namespace sikku
