// engine/import/cpfg_words.h: translates the words, predecessors and contexts of cpfg.
#pragma once

#include "engine/import/cpfg_system.h"

#include <functional>
#include <string>
#include <vector>

namespace sikku::cpfg {

/// Translates the words of one file into the pattern language. Collects their letters.
class Words {
public:
    Words(const View& view, Defines& defines, Expressions& expressions, Report& report)
        : view_(view), defines_(defines), expressions_(expressions), report_(report) {}

    /// Reads a word. @param is_drawn  true for successors of a homomorphism, which the turtle reads unchanged
    /// @throws Fault
    std::string word(Reader& reader, bool is_drawn);
    /// Reads modules up to '<', '>', ':' or an arrow; ignores `*`. @throws Fault
    std::vector<Formal> formal_modules(Reader& reader);

    Letters letters;

private:
    std::string symbol(Reader& reader);
    std::string surface(char byte);
    void note(char letter, std::size_t at);
    void finish(std::string& result, const std::string& letter, std::vector<std::string> arguments, std::size_t at);
    void note_width(const std::string& letter, const std::vector<std::string>& arguments);
    std::vector<std::string> parameters(Reader& reader, std::size_t at, const std::function<std::string()>& read);

    const View& view_;
    Defines& defines_;
    Expressions& expressions_;
    Report& report_;
    bool after_tilde_ = false;
};

/// True if the reader is at the arrow of a production.
bool is_arrow(const Reader& reader);
/// @throws Fault if `byte` is not a symbol of cpfg
void check_symbol(char byte, std::size_t at);

}  // namespace sikku::cpfg
