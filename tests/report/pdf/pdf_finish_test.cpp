#include "report/pdf/pdf_finish.h"

#include <gtest/gtest.h>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFEmbeddedFileDocumentHelper.hh>
#include <qpdf/QPDFNameTreeObjectHelper.hh>
#include <qpdf/QPDFOutlineDocumentHelper.hh>
#include <qpdf/QPDFWriter.hh>

#include "base/errors.h"

namespace meshfolio::report {
namespace {

/// Returns a PDF of `pages` empty pages with an entry of the outline for each title; "> " marks those one level deeper.
std::string small_pdf(int pages, const std::vector<std::string>& titles, const std::string& date) {
    QPDF pdf;
    pdf.emptyPDF();
    std::vector<QPDFObjectHandle> sheets;
    for (int i = 0; i < pages; ++i) {
        sheets.push_back(pdf.makeIndirectObject(QPDFObjectHandle::parse("<< /Type /Page /MediaBox [0 0 595 842] >>")));
        pdf.addPage(sheets.back(), false);
    }
    QPDFObjectHandle outlines = pdf.makeIndirectObject(QPDFObjectHandle::parse("<< /Type /Outlines >>"));
    QPDFObjectHandle last[2] = {QPDFObjectHandle::newNull(), QPDFObjectHandle::newNull()};
    for (std::size_t i = 0; i < titles.size(); ++i) {
        const bool deeper = titles[i].compare(0, 2, "> ") == 0;
        QPDFObjectHandle item = pdf.makeIndirectObject(QPDFObjectHandle::newDictionary());
        QPDFObjectHandle parent = deeper ? last[0] : outlines;
        item.replaceKey("/Title", QPDFObjectHandle::newUnicodeString(deeper ? titles[i].substr(2) : titles[i]));
        item.replaceKey("/Parent", parent);
        item.replaceKey("/Dest", QPDFObjectHandle::newArray({sheets[i % sheets.size()], QPDFObjectHandle::newName("/Fit")}));
        if (!parent.hasKey("/First")) parent.replaceKey("/First", item);
        if (!last[deeper].isNull() && parent.hasKey("/Last")) last[deeper].replaceKey("/Next", item);
        parent.replaceKey("/Last", item);
        last[deeper] = item;
    }
    if (!titles.empty()) pdf.getRoot().replaceKey("/Outlines", outlines);
    QPDFObjectHandle info = QPDFObjectHandle::parse("<< /Producer (Skia/PDF) /Creator (Chromium) >>");
    info.replaceKey("/CreationDate", QPDFObjectHandle::newString(date));
    pdf.getTrailer().replaceKey("/Info", pdf.makeIndirectObject(info));
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

const std::vector<std::string> joined{"Curvature ofmeshes", "1Uniformcurvature", "> 1.1 Method", "2 Ellipsoid"};

PdfDetails details() {
    PdfDetails details;
    details.title = "Curvature of meshes";
    details.author = "Ünal";
    details.creator = "meshfolio 1";
    details.outline = {"Curvature of meshes", "1 Uniform curvature", "1.1 Method", "2 Ellipsoid"};
    details.attachment_name = "results.json";
    details.attachment = "{\"a\": 1}\n";
    return details;
}

TEST(PdfFinish, DoesNotDependOnTheTimeOfPrinting) {
    EXPECT_EQ(finish_pdf(small_pdf(3, joined, "D:20260101000000Z"), details()),
              finish_pdf(small_pdf(3, joined, "D:20270203040506Z"), details()));
}

/// With a table of two headers and a cell below each, whose elements are named by a counter that begins at `first`; the second header
/// comes before the first one in the order of the names if `turned`.
std::string pdf_with_a_table(int first, bool turned) {
    const std::string plain = small_pdf(1, joined, "D:2026");
    QPDF pdf;
    pdf.processMemoryFile("plain", plain.data(), plain.size());
    QPDFObjectHandle structure = pdf.makeIndirectObject(QPDFObjectHandle::parse("<< /Type /StructTreeRoot >>"));
    QPDFObjectHandle table = pdf.makeIndirectObject(QPDFObjectHandle::parse("<< /S /Table >>"));
    std::vector<QPDFObjectHandle> cells, names(4);
    const std::string ids[] = {"(node" + std::to_string(first + (turned ? 2 : 0)) + ")", "(node" + std::to_string(first + 1) + ")"};
    for (const std::string& id : ids) cells.push_back(pdf.makeIndirectObject(QPDFObjectHandle::parse("<< /S /TH /ID " + id + " /K 0 >>")));
    for (const std::string& id : ids)
        cells.push_back(pdf.makeIndirectObject(QPDFObjectHandle::parse("<< /S /TD /A [<< /O /Table /Headers [" + id + " (node9)] >>] >>")));
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t place = turned ? 1 - i : i;
        names[2 * place] = QPDFObjectHandle::parse(ids[i]);
        names[2 * place + 1] = cells[i];
    }
    for (QPDFObjectHandle cell : cells) cell.replaceKey("/P", table);
    table.replaceKey("/K", QPDFObjectHandle::newArray(cells));
    table.replaceKey("/P", structure);
    QPDFObjectHandle tree = QPDFObjectHandle::newDictionary();
    tree.replaceKey("/Names", QPDFObjectHandle::newArray(names));
    structure.replaceKey("/IDTree", pdf.makeIndirectObject(tree));
    structure.replaceKey("/K", table);
    pdf.getRoot().replaceKey("/StructTreeRoot", structure);
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

TEST(PdfFinish, DoesNotDependOnTheNamesOfElements) {
    const std::string expected = finish_pdf(pdf_with_a_table(22, false), details());
    EXPECT_EQ(expected, finish_pdf(pdf_with_a_table(35, false), details()));
    EXPECT_EQ(expected, finish_pdf(pdf_with_a_table(22, true), details()));
    EXPECT_EQ(expected, finish_pdf(expected, details()));
}

TEST(PdfFinish, CellsKeepTheirHeaders) {
    const std::string bytes = finish_pdf(pdf_with_a_table(22, true), details());
    QPDF pdf;
    pdf.processMemoryFile("finished", bytes.data(), bytes.size());
    QPDFObjectHandle structure = pdf.getRoot().getKey("/StructTreeRoot"), cells = structure.getKey("/K").getKey("/K");
    const auto headers = QPDFNameTreeObjectHelper(structure.getKey("/IDTree"), pdf).getAsMap();
    ASSERT_EQ(headers.size(), 2u);
    for (int i = 0; i < 2; ++i) {
        QPDFObjectHandle names = cells.getArrayItem(2 + i).getKey("/A").getArrayItem(0).getKey("/Headers");
        ASSERT_EQ(names.getArrayNItems(), 1);   // the other one names no element
        const auto header = headers.find(names.getArrayItem(0).getStringValue());
        ASSERT_NE(header, headers.end());
        EXPECT_EQ(header->second.getObjGen(), cells.getArrayItem(i).getObjGen());
    }
}

TEST(PdfFinish, TheOutlineGetsFullTitlesAndKeepsItsPages) {
    const PdfContents contents = contents_of_pdf(finish_pdf(small_pdf(3, joined, "D:2026"), details()));
    EXPECT_EQ(contents.pages, 3);
    ASSERT_EQ(contents.outline.size(), 4u);
    const int levels[] = {1, 1, 2, 1}, pages[] = {1, 2, 3, 1};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(contents.outline[i].title, details().outline[i]);
        EXPECT_EQ(contents.outline[i].level, levels[i]);
        EXPECT_EQ(contents.outline[i].page, pages[i]);
    }
}

TEST(PdfFinish, RefusesAnOutlineThatDiffersFromThePage) {
    PdfDetails other = details();
    other.outline[1] = "1 Uniform curvatures";
    EXPECT_THROW(finish_pdf(small_pdf(1, joined, ""), other), EngineError);
    other.outline.pop_back();
    EXPECT_THROW(finish_pdf(small_pdf(1, joined, ""), other), EngineError);
}

TEST(PdfFinish, HasTitleAuthorAndTheResultsAttached) {
    const std::string bytes = finish_pdf(small_pdf(1, joined, "D:2026"), details());
    QPDF pdf;
    pdf.processMemoryFile("finished", bytes.data(), bytes.size());
    QPDFObjectHandle info = pdf.getTrailer().getKey("/Info");
    EXPECT_EQ(info.getKey("/Title").getUTF8Value(), "Curvature of meshes");
    EXPECT_EQ(info.getKey("/Author").getUTF8Value(), "Ünal");
    EXPECT_EQ(info.getKey("/Creator").getUTF8Value(), "meshfolio 1");
    EXPECT_EQ(info.getKey("/Producer").getUTF8Value(), "Skia/PDF");
    EXPECT_EQ(info.getKey("/CreationDate").getUTF8Value(), "D:19800101000000Z");
    const auto files = QPDFEmbeddedFileDocumentHelper(pdf).getEmbeddedFiles();
    ASSERT_EQ(files.size(), 1u);
    EXPECT_EQ(files.begin()->first, "results.json");
    const auto data = files.begin()->second->getEmbeddedFileStream().getStreamData();
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(data->getBuffer()), data->getSize()), details().attachment);
}

TEST(PdfFinish, RefusesOtherFiles) {
    EXPECT_THROW(contents_of_pdf("<html>"), EngineError);
    EXPECT_THROW(contents_of_pdf(""), EngineError);
    EXPECT_THROW(finish_pdf("%PDF-1.7\n", details()), EngineError);
}

TEST(PdfFinish, DatesComeFromSourceDateEpoch) {
    EXPECT_EQ(pdf_date("86399"), "D:19700101235959Z");
    EXPECT_EQ(pdf_date("1700000000"), "D:20231114221320Z");
    for (const char* wrong : {"", "yesterday", "-1", "1e9", "99999999999999"}) EXPECT_EQ(pdf_date(wrong), "D:19800101000000Z") << wrong;
}

}   // namespace
}   // namespace meshfolio::report
