#include "engine/base/output.h"

#include "engine/base/output_file.h"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

class FileSystem : public Destination {
public:
    std::unique_ptr<Output> open(const std::filesystem::path& name) override {
        return std::make_unique<OutputFile>(name);
    }
};

/// An output that is stored in the map on commit().
class NamedMemory : public MemoryOutput {
public:
    NamedMemory(std::map<std::string, std::string>& outputs, std::string name)
        : outputs_(outputs), name_(std::move(name)) {}
    void commit() override {
        MemoryOutput::commit();
        outputs_[name_] = std::move(bytes_);
    }

private:
    std::map<std::string, std::string>& outputs_;
    std::string name_;
};

}  // namespace

void MemoryOutput::insert(std::uint64_t position, std::string_view bytes) {
    bytes_.insert(static_cast<std::size_t>(position), bytes);
}

void MemoryOutput::overwrite(std::uint64_t position, std::string_view bytes) {
    bytes_.replace(static_cast<std::size_t>(position), bytes.size(), bytes);
}

const std::filesystem::path& MemoryOutput::temporary() {
    if (!file_) {
        file_ = std::make_unique<OutputFile>(temporary_folder() / "sikku");
        file_->write(bytes_);
    }
    return file_->temporary();
}

void MemoryOutput::commit() {
    if (!file_) return;
    std::ifstream stream(file_->temporary(), std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(stream), {});
    if (!stream) throw std::runtime_error("cannot read the temporary file " + file_->temporary().string());
    file_.reset();
}

Destination& file_system() {
    static FileSystem files;
    return files;
}

std::unique_ptr<Output> MemoryDestination::open(const std::filesystem::path& name) {
    return std::make_unique<NamedMemory>(outputs_, name.string());
}

std::string MemoryDestination::take(const std::string& name) {
    return std::move(outputs_.at(name));
}

}  // namespace sikku
