#include "report/pdf/pdf_packing.h"

#include <gtest/gtest.h>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFWriter.hh>

#include "base/errors.h"

namespace meshfolio::report {
namespace {

/// Its catalogue refers to as many numbers, and to as many streams that end like an object.
std::string plain_pdf(int count) {
    QPDF pdf;
    pdf.emptyPDF();
    std::vector<QPDFObjectHandle> numbers, streams;
    for (int i = 0; i < count; ++i) {
        numbers.push_back(pdf.makeIndirectObject(QPDFObjectHandle::newInteger(i)));
        streams.push_back(QPDFObjectHandle::newStream(&pdf, std::to_string(i) + "\nendobj\n7 0 obj\n"));
    }
    pdf.getRoot().replaceKey("/Numbers", QPDFObjectHandle::newArray(numbers));
    pdf.getRoot().replaceKey("/Streams", QPDFObjectHandle::newArray(streams));
    pdf.getRoot().replaceKey("/Text", QPDFObjectHandle::newString("endstream"));
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.setMinimumPDFVersion("1.5");
    writer.setDeterministicID(true);
    writer.setObjectStreamMode(qpdf_o_disable);
    writer.setCompressStreams(false);
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

TEST(PdfPacking, EveryObjectIsFoundAgain) {
    for (const int count : {0, 1, 97, 98, 99, 100, 101, 250}) {
        const std::string packed = packed_pdf(plain_pdf(count));
        QPDF pdf;
        pdf.processMemoryFile("packed", packed.data(), packed.size());
        EXPECT_TRUE(pdf.getWarnings().empty());
        QPDFObjectHandle numbers = pdf.getRoot().getKey("/Numbers"), streams = pdf.getRoot().getKey("/Streams");
        ASSERT_EQ(numbers.getArrayNItems(), count);
        for (int i = 0; i < count; ++i) {
            EXPECT_EQ(numbers.getArrayItem(i).getIntValue(), i);
            const auto data = streams.getArrayItem(i).getStreamData();
            EXPECT_TRUE(
                std::string(reinterpret_cast<const char*>(data->getBuffer()), data->getSize()).starts_with(std::to_string(i) + "\n"));
        }
    }
    EXPECT_LT(packed_pdf(plain_pdf(0)).size(), 1000u);
}

TEST(PdfPacking, WhatIsNoPlainPdfIsRefused) {
    for (const char* wrong : {"", "%PDF-1.7\n", "%PDF-1.7\nstartxref\n9\n%%EOF", "startxref\n0\n"})
        EXPECT_THROW(packed_pdf(wrong), EngineError) << wrong;
    EXPECT_THROW(packed_pdf(packed_pdf(plain_pdf(3))), EngineError);
}

}   // namespace
}   // namespace meshfolio::report
