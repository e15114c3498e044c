// music/melody/symbol_table.h: the sounds of the symbols of a word, from the keys note, drum, chord, rest and change.
#pragma once

#include "engine/language/grammar.h"
#include "engine/language/pattern.h"
#include "music/melody/harmony.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

struct Melody;

/// A pitch of a row: a degree of the scale, or a MIDI key with the degree nearest to it.
struct TablePitch {
    std::int64_t degree = 0;
    std::optional<double> key{};  ///< before transposition; for drums their keys in General MIDI
};

/// Property that a symbol changes for the notes after it.
enum class SoundChange {
    velocity,  ///< adds to the velocity
    level,     ///< sets the velocity of notes that state none
    octave,    ///< moves by periods of the scale
    degree     ///< moves by degrees
};

/// A row of the table of symbols.
struct SymbolRow {
    enum class Kind { note, drum, chord, rest, change };
    std::string symbol;  ///< as SymbolInfo::letter
    Kind kind = Kind::note;
    std::vector<TablePitch> pitches;  ///< at most 10; none for a note whose module states the degree
    double steps = 1;                 ///< duration in steps of the unit, above 0
    int velocity = 0;                 ///< 1 to 127; 0: that of the key `velocity`
    bool is_dynamic = false;          ///< the velocity is stated as `ppp` to `fff`, `loud` or `soft`
    std::optional<Chord> named;       ///< chord that is stated by numeral or name
    SoundChange change = SoundChange::velocity;
    double amount = 0;  ///< amount of the change

    bool is_sounding() const { return kind != Kind::rest && kind != Kind::change; }
    bool is_drum() const { return kind == Kind::drum; }
};

/// The table of symbols of a pattern.
struct SymbolTable {
    std::vector<SymbolRow> rows;
    bool has_named_notes = false;  ///< symbols without a row sound the notes they name

    bool empty() const { return rows.empty() && !has_named_notes; }
    /// Largest number of notes that one symbol sounds.
    int most_notes() const;
};

/// Reads the keys of the table into `melody.table`; uses its scale, tonic and unit. Errors go to `diagnostics`.
void read_symbol_table(const Pattern& pattern, Melody& melody, Diagnostics& diagnostics);

/// A symbol of a grammar as the table reads it, with the parameters of its module.
struct SymbolEntry {
    bool has_row = false;
    SymbolRow row;        ///< with parameters in place of the stated values
    std::string problem;  ///< problem of the parameters; empty: none
};

/// An entry for each symbol of the grammar; none if the table is empty. Parameters of modules are, in this order: the
/// degree, if the key of a note states no pitch; the duration in steps; the velocity. A change has its amount.
std::vector<SymbolEntry> entries_of(const Grammar& grammar, const Melody& melody);

/// Rows whose symbols no word of the grammar contains.
std::vector<std::string> unused_rows(const Grammar& grammar, const SymbolTable& table);

/// Reports whether symbols derivable from the axiom sound drums, and whether they sound pitches.
struct SoundKinds {
    bool has_drums = false;
    bool has_pitches = true;
};
SoundKinds sound_kinds(const Grammar& grammar, const Melody& melody);

}  // namespace sikku
