#include "art/image/icc.h"

#include "engine/base/input_file.h"

#include <lcms2.h>
#include <lcms2_plugin.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

namespace sikku {
namespace {

constexpr std::uint64_t most_profile_bytes = std::uint64_t{16} << 20;
/// The tables of the largest published profiles take less than 20 MB.
constexpr std::size_t most_library_bytes = std::size_t{64} << 20;

/// Limits the memory of the library: a profile may state any number of tables of any size.
class Memory {
public:
    static cmsPluginMemHandler* plugin() {
        static cmsPluginMemHandler handler = {{cmsPluginMagicNumber, LCMS_VERSION, cmsPluginMemHandlerSig, nullptr},
                                              allocate,
                                              release,
                                              reallocate,
                                              nullptr,
                                              nullptr,
                                              nullptr};
        return &handler;
    }

private:
    struct alignas(std::max_align_t) Block {
        Memory* owner;
        std::size_t size;
    };

    static void* allocate(cmsContext context, cmsUInt32Number size) {
        // While the context is made it has no owner yet.
        auto* const owner = context ? static_cast<Memory*>(cmsGetContextUserData(context)) : nullptr;
        if (owner && (size > most_library_bytes || owner->used_.fetch_add(size) > most_library_bytes - size)) {
            if (size <= most_library_bytes) owner->used_ -= size;
            return nullptr;
        }
        void* const memory = std::malloc(sizeof(Block) + size);
        if (!memory) {
            if (owner) owner->used_ -= size;
            return nullptr;
        }
        return new (memory) Block{owner, size} + 1;
    }
    static void release(cmsContext, void* bytes) {
        if (!bytes) return;
        Block* const block = static_cast<Block*>(bytes) - 1;
        if (block->owner) block->owner->used_ -= block->size;
        std::free(block);
    }
    static void* reallocate(cmsContext context, void* bytes, cmsUInt32Number size) {
        void* const larger = allocate(context, size);
        if (!larger || !bytes) return larger;
        std::memcpy(larger, bytes, std::min<std::size_t>((static_cast<Block*>(bytes) - 1)->size, size));
        release(context, bytes);
        return larger;
    }

    std::atomic<std::size_t> used_ = 0;
};

struct Closer {
    void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, Closer>;

/// Errors of the library are reported by the return values of its functions.
struct Context {
    Context() : handle(cmsCreateContext(Memory::plugin(), &memory)) {
        if (!handle) throw std::runtime_error("lcms2: out of memory");
        cmsSetLogErrorHandlerTHR(handle, [](cmsContext, cmsUInt32Number, const char*) {});
    }
    ~Context() { cmsDeleteContext(handle); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    Memory memory;
    cmsContext handle;
};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw std::runtime_error("the ICC profile '" + file.string() + "': " + why);
}

std::vector<std::uint8_t> read_profile(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) refuse(file, error ? error.message() : "no such file");
    if (!std::filesystem::is_regular_file(file, error)) refuse(file, "it is not a regular file");
    try {
        const InputFile input(file);
        if (input.size() > most_profile_bytes) refuse(file, "it is larger than 16 MB");
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(input.size()));
        if (input.read(0, reinterpret_cast<char*>(bytes.data()), bytes.size()) == bytes.size()) return bytes;
        refuse(file, "it cannot be read");
    } catch (const std::system_error& failure) {
        refuse(file, failure.code().message());
    }
}

/// The description of a profile in printable ASCII, at most 200 characters.
std::string description(cmsHPROFILE profile) {
    char text[200] = {};
    cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text, sizeof text);
    std::string result;
    for (std::size_t i = 0; i + 1 < std::size(text) && text[i] != 0; ++i) {
        if (text[i] >= 0x20 && text[i] < 0x7F) result += text[i];
    }
    return result;
}

}  // namespace

struct InkTransform::Handles {
    Context context;
    std::vector<std::uint8_t> bytes;
    cmsHTRANSFORM transform = nullptr;
    cmsHTRANSFORM exact = nullptr;  // into 16 bits
    std::string name;
    bool is_of_output = false;
    ~Handles() {
        if (transform) cmsDeleteTransform(transform);
        if (exact) cmsDeleteTransform(exact);
    }
};

InkTransform::InkTransform(const std::filesystem::path& file) : handles_(std::make_unique<Handles>()) {
    handles_->bytes = read_profile(file);
    const cmsContext context = handles_->context.handle;
    const Profile inks(cmsOpenProfileFromMemTHR(context, handles_->bytes.data(),
                                                static_cast<cmsUInt32Number>(handles_->bytes.size())));
    if (!inks) refuse(file, "it is not an ICC profile");
    if (cmsGetColorSpace(inks.get()) != cmsSigCmykData) refuse(file, "its colours are not CMYK");
    const Profile colours(cmsCreate_sRGBProfileTHR(context));
    if (!colours) throw std::runtime_error("lcms2: out of memory");
    handles_->transform =
        cmsCreateTransformTHR(context, colours.get(), TYPE_RGB_8, inks.get(), TYPE_CMYK_8,
                              INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_BLACKPOINTCOMPENSATION | cmsFLAGS_NOCACHE);
    handles_->exact =
        cmsCreateTransformTHR(context, colours.get(), TYPE_RGB_16, inks.get(), TYPE_CMYK_16,
                              INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_BLACKPOINTCOMPENSATION | cmsFLAGS_NOCACHE);
    if (!handles_->transform || !handles_->exact) refuse(file, "it is damaged or cannot convert colours to inks");
    handles_->is_of_output = cmsGetDeviceClass(inks.get()) == cmsSigOutputClass;
    handles_->name = description(inks.get());
}

InkTransform::~InkTransform() = default;

const std::vector<std::uint8_t>& InkTransform::profile() const {
    return handles_->bytes;
}

std::string InkTransform::name() const {
    return handles_->name;
}

bool InkTransform::is_of_output() const {
    return handles_->is_of_output;
}

std::array<double, 4> InkTransform::convert(std::array<std::uint8_t, 3> rgb) const {
    std::array<std::uint16_t, 3> from{};
    std::array<std::uint16_t, 4> to{};
    for (std::size_t i = 0; i < 3; ++i) from[i] = static_cast<std::uint16_t>(257 * rgb[i]);
    cmsDoTransform(handles_->exact, from.data(), to.data(), 1);
    std::array<double, 4> inks{};
    for (std::size_t i = 0; i < 4; ++i) inks[i] = to[i] / 65535.0;
    return inks;
}

void InkTransform::convert(std::span<const std::uint8_t> rgb, std::span<std::uint8_t> inks) const {
    const std::size_t pixels = std::min(rgb.size() / 3, inks.size() / 4);
    // Drawings are mostly flat: of each run of equal pixels one is converted.
    constexpr std::size_t most = 1024;
    std::uint8_t colours[3 * most], converted[4 * most];
    std::size_t ends[most];
    for (std::size_t at = 0; at < pixels;) {
        std::size_t runs = 0;
        std::size_t next = at;
        while (next < pixels && runs < most) {
            const std::uint8_t* colour = &rgb[3 * next];
            std::memcpy(colours + 3 * runs, colour, 3);
            // Shifted by three bytes, pixels of a run look the same.
            const auto ends_at = std::mismatch(colour + 3, rgb.data() + 3 * pixels, colour).first;
            next += 1 + static_cast<std::size_t>(ends_at - (colour + 3)) / 3;
            ends[runs++] = next;
        }
        cmsDoTransform(handles_->transform, colours, converted, static_cast<cmsUInt32Number>(runs));
        for (std::size_t run = 0; run < runs; ++run) {
            for (; at < ends[run]; ++at) std::memcpy(&inks[4 * at], converted + 4 * run, 4);
        }
    }
}

}  // namespace sikku
