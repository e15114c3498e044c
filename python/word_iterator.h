// python/word_iterator.h: the modules of a word, in lists.
#pragma once

#include "engine/derivation/word_stream.h"
#include "engine/language/document.h"

#include <pybind11/pybind11.h>
#include <sys/types.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace sikku {

/// An iterator over the word of a document, which is derived as it is read. Modules without parameters are created
/// only once. Must not be used after fork().
class WordIterator {
public:
    /// @param interpreted  whether to apply the productions under `interpret:`
    WordIterator(const Document& document, bool interpreted);
    ~WordIterator();
    WordIterator(const WordIterator&) = delete;
    WordIterator& operator=(const WordIterator&) = delete;

    /// The next modules, up to 4096, as a list of sikku.Module, because a call from Python costs more than a module.
    /// @throws pybind11::stop_iteration, and exceptions of derive()
    pybind11::list next();
    /// Ends the derivation; no further modules follow.
    void close();
    /// Closes all iterators, before Python ends.
    static void close_all();

private:
    void read_piece();
    pybind11::object next_module();

    std::shared_ptr<const Grammar> grammar_;
    std::unique_ptr<WordStream> stream_;
    pid_t process_;
    pybind11::object type_;
    std::vector<pybind11::object> constants_;  ///< by symbol; none for symbols with arity
    WordPiece piece_;
    std::size_t symbol_ = 0;    ///< next symbol in piece_
    std::size_t argument_ = 0;  ///< next argument in piece_
};

}  // namespace sikku
