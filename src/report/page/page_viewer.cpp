#include "report/page/page_viewer.h"

#include <libdeflate.h>

#include <memory>
#include <new>

#include "embedded_viewer.h"
#include "report/escape.h"

namespace meshfolio::report {

std::string_view viewer_program() { return meshfolio_embedded::embedded_viewer().front().bytes; }

std::string packed(std::string_view bytes) {
    constexpr int level = 9;   // of 12: beyond it takes several times as long for a percent
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(libdeflate_alloc_compressor(level),
                                                                                                   &libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::string zlib(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
    zlib.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), zlib.data(), zlib.size()));
    return base64(zlib);
}

}   // namespace meshfolio::report
