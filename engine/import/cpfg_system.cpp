#include "engine/import/cpfg_system.h"

namespace sikku::cpfg {

std::string type_of(const std::vector<Formal>& modules) {
    std::string key;
    for (const Formal& module : modules) key += fmt::format("{}({} ", module.letter, module.names.size());
    return key;
}

}  // namespace sikku::cpfg
