// engine/base/output.h: destinations of finished bytes: files that appear whole or not at all, or memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace sikku {

/// An output being written. It appears on commit(); without commit() it is discarded. Every failure (a missing
/// folder, a full disk) is a std::runtime_error that names the output and the cause.
class Output {
public:
    Output() = default;
    virtual ~Output() = default;
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    virtual void write(std::string_view bytes) = 0;
    /// Number of bytes written so far.
    virtual std::uint64_t size() const = 0;
    /// True if insert(), overwrite() and temporary() may be used: not for devices and pipes.
    virtual bool can_insert() const = 0;
    /// Inserts `bytes` before the byte at `position` (at most size()). Cost: linear in the bytes after it.
    virtual void insert(std::uint64_t position, std::string_view bytes) = 0;
    /// Replaces bytes already written.
    virtual void overwrite(std::uint64_t position, std::string_view bytes) = 0;
    /// A temporary file with all bytes written so far, for libraries and programs that open files themselves. Do not
    /// call write() afterwards.
    virtual const std::filesystem::path& temporary() = 0;
    /// Call once, last.
    virtual void commit() = 0;
};

/// Opens outputs by name. A work may open several, such as the sheets of a tiled print or the materials of a model.
class Destination {
public:
    virtual ~Destination() = default;
    virtual std::unique_ptr<Output> open(const std::filesystem::path& name) = 0;
};

/// The file system: each output is an OutputFile.
Destination& file_system();

/// An output in memory.
class MemoryOutput : public Output {
public:
    void write(std::string_view bytes) override { bytes_ += bytes; }
    std::uint64_t size() const override { return bytes_.size(); }
    bool can_insert() const override { return true; }
    void insert(std::uint64_t position, std::string_view bytes) override;
    void overwrite(std::uint64_t position, std::string_view bytes) override;
    /// A file in the system's folder for temporary files; commit() reads it back.
    const std::filesystem::path& temporary() override;
    void commit() override;
    const std::string& bytes() const { return bytes_; }

protected:
    std::string bytes_;

private:
    std::unique_ptr<Output> file_;  // never committed
};

/// Keeps the committed outputs in memory, by name.
class MemoryDestination : public Destination {
public:
    std::unique_ptr<Output> open(const std::filesystem::path& name) override;
    const std::map<std::string, std::string>& outputs() const { return outputs_; }
    /// Removes an output and returns its bytes. @throws std::out_of_range if there is none of that name
    std::string take(const std::string& name);

private:
    std::map<std::string, std::string> outputs_;
};

}  // namespace sikku
