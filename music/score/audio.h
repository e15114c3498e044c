// music/score/audio.h: renders MIDI files as sound with the program FluidSynth.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace sikku {

/// 16 bits, two channels, 44,100 frames a second in either.
enum class AudioFormat { wav, flac };

/// Called about ten times a second of work; `seconds` of sound are rendered. What it throws ends the work.
using AudioWatch = std::function<void(double seconds)>;

/// Longer music is refused: what a WAV file of 4 GB holds, 6 hours 45 minutes.
constexpr double most_audio_seconds = 24'347;

/// The soundfont that render_audio takes: what the environment variable SIKKU_SOUNDFONT names, else the first of
/// those that distributions install below /usr/share/sounds or /usr/share/soundfonts (default-GM before others, then
/// alphabetically).
/// @throws std::runtime_error if there is none, or if SIKKU_SOUNDFONT names no readable file; it tells what to
/// install
std::filesystem::path find_soundfont();

/// Renders `midi` with the program `fluidsynth` found in PATH and writes `output`, which is replaced. The loudest
/// sample is at -1 dBFS; a score without sound stays silent. The sound is as long as the score and three seconds more
/// for the last notes to fade (with FluidSynth 2.3). The same bytes each time for the same FluidSynth and soundfont.
///
/// Memory: a few hundred kB here and what FluidSynth and the soundfont take. Disk: for the time of the work twice the
/// size of the WAV, nameless, in the folder of `output`, so that nothing is left behind whatever happens. Cost: a
/// second for some hundred seconds of music.
///
/// `output` is not written before the rendering has succeeded, and always from front to back.
/// @param shown  name of the output in messages, where `output` is a temporary file; empty: `output`
/// @return the loudest sample before that, in units of full scale; 0 if the soundfont has no sound for these keys
/// @throws std::runtime_error if fluidsynth or a soundfont is missing (it tells what to install), if fluidsynth fails
///         (with what it printed), if a file cannot be read or written, and for more sound than a WAV file of 4 GB
///         holds, 6 hours 45 minutes
double render_audio(const std::filesystem::path& midi, const std::filesystem::path& output, AudioFormat format,
                    const AudioWatch& watch = {}, const std::filesystem::path& shown = {});

}  // namespace sikku
