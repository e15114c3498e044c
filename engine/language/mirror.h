// engine/language/mirror.h: mirror images of words, for the key `mirror`.
#pragma once

#include "engine/language/word_reader.h"

#include <map>
#include <string>

namespace sikku {

/// Exchanges left and right in words: the symbols of each pair that `mirror:` lists, `+` and `-`, `\` and `/`.
class Mirror {
public:
    /// Reads `mirror:`; without it there are no pairs.
    Mirror(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics);

    bool has_pairs() const { return !images_.empty(); }
    /// The mirror image of a word, whose symbols the reader numbers.
    Word image(const Word& word) const;

private:
    struct Image {
        std::string letter;
        bool is_name = false;
    };

    WordReader& reader_;
    std::map<std::string, Image> images_;  ///< by letter
};

}  // namespace sikku
