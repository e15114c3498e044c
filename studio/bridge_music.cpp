// Answers about notes, and about arrangements: several patterns that are played as one piece.
#include "engine/base/input_file.h"
#include "engine/base/memory.h"
#include "engine/language/arrangement_library.h"
#include "engine/language/pattern_library.h"
#include "music/arrangement.h"
#include "music/scores.h"
#include "studio/bridge_answers.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

std::string contents_of(const std::filesystem::path& file, const std::string& name) {
    return read_file(file, name, most_toml_bytes, {});
}

/// Tracks name bundled patterns, or those in the arrangement's own tables: the page has no other files.
NamedPattern bundled_pattern(const std::string& name) {
    const LibraryPattern* known = PatternLibrary::bundled().find(name);
    if (!known)
        throw std::runtime_error("the arrangement names the pattern '" + name +
                                 "', which is neither bundled nor in the file; expected a [[pattern]] table with it");
    const std::string file = name + ".lsys";
    return {file, contents_of(known->file, file)};
}

/// The arrangement of a request. @throws FileError, PatternError, std::runtime_error
Arrangement arrangement_of(const Json& request) {
    const Json& given = member(request, "arrangement");
    return read_arrangement(text_of(given, "name"), text_of(given, "text"), bundled_pattern);
}

template <typename Number>
void append_double(std::string& bytes, Number number) {
    const auto value = static_cast<double>(number);
    std::array<char, sizeof value> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    bytes.append(raw.data(), raw.size());
}

NoteList notes_of(const Json& request, const Monitor& monitor) {
    if (request.contains("arrangement")) return list_notes(arrangement_of(request), options_of(request), monitor);
    const Assignment assigned = assign(scores(), document_of(request), options_of(request));
    return list_notes(std::span(&assigned.document, 1), assigned.options, monitor);
}

}  // namespace

Json answer_notes(const Json& request, const Monitor& monitor, std::string& bytes) {
    const NoteList list = notes_of(request, monitor);
    for (const Note& note : list.notes) {
        append_double(bytes, note.onset);
        append_double(bytes, note.duration);
        append_double(bytes, note.key);
        append_double(bytes, note.velocity);
        append_double(bytes, note.voice);
        append_double(bytes, note.from.x);
        append_double(bytes, note.from.y);
        append_double(bytes, note.to.x);
        append_double(bytes, note.to.y);
        append_double(bytes, note.symbol == 0 ? -1 : static_cast<double>(note.symbol));
    }
    std::size_t glides = 0;
    for (std::size_t i = 0; i < list.notes.size(); ++i) {
        const Glide& glide = list.notes[i].glide;
        if (glide.semitones == 0) continue;
        append_double(bytes, i);
        append_double(bytes, glide.ticks);
        append_double(bytes, glide.semitones);
        ++glides;
    }
    Json parts = Json::array();
    for (const Part& part : list.parts) {
        parts.push_back({{"name", part.name},
                         {"scale", part.scale},
                         {"program", part.program},
                         {"voices", part.voices},
                         {"drums", part.is_drums}});
    }
    Json changes = Json::array();
    for (const SectionChange& change : list.changes) {
        const Meter& meter = change.to.meter;
        changes.push_back(
            {{"onset", change.onset}, {"tempo", change.to.tempo}, {"beats", meter.beats}, {"unit", meter.unit}});
    }
    return {{"count", list.notes.size()},   {"glides", glides},           {"end", list.end},
            {"tempo", list.tempo},          {"beats", list.meter.beats},  {"unit", list.meter.unit},
            {"upbeat", list.upbeat},        {"ticks", ticks_per_quarter}, {"parts", std::move(parts)},
            {"changes", std::move(changes)}};
}

Json answer_arrangements() {
    Json list = Json::array();
    for (const std::string& name : bundled_arrangements()) {
        const std::string file = name + ".toml";
        const std::string text = contents_of(*bundled_arrangement(name), file);
        const Arrangement arrangement = read_arrangement(file, text, bundled_pattern);
        list.push_back({{"name", name},
                        {"title", arrangement.title},
                        {"source", arrangement.source},
                        {"parts", arrangement.tracks.size()},
                        {"text", text}});
    }
    return {{"arrangements", std::move(list)}};
}

Json answer_make_arrangement(const Json& request, const Monitor& monitor, std::string& bytes) {
    const std::string format = text_of(request, "format");
    if (&interpreter_of(request) != &scores()) throw BadRequest("an arrangement has no picture; expected 'play'");
    const std::string stem = std::filesystem::path(text_of(member(request, "arrangement"), "name")).stem().string();
    const std::unique_ptr<Work> work = plan_score(arrangement_of(request), format, options_of(request));
    return made_by(*work, stem + "." + format, monitor, bytes);
}

Json made_by(Work& work, const std::string& name, const Monitor& monitor, std::string& bytes) {
    MemoryDestination memory;
    const Made made = work.make(memory, name, monitor);
    Json outputs = Json::array();
    for (const auto& [output, content] : memory.outputs()) {
        outputs.push_back({{"name", output}, {"size", content.size()}});
        bytes += content;
    }
    return {{"outputs", std::move(outputs)}, {"remarks", json_of(made.remarks)}};
}

}  // namespace sikku
