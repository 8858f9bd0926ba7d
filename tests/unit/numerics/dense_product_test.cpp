#include "numerics/dense_product.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <complex>

namespace dovetail::numerics {
namespace {

// OpenBLAS's product with one column reads an entry more than there are, of which this one ends the process.
TEST(DenseProduct, OfOneColumnReadsNoFurtherThanItGoes) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* pages = mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(pages, MAP_FAILED);
  char* end = static_cast<char*>(pages) + page;
  ASSERT_EQ(mprotect(end, page, PROT_NONE), 0);
  for (const Eigen::Index rows : {6, 38, 120})
    for (const Eigen::Index columns : {1, 3, 4, 20}) {
      const Eigen::MatrixXcd a = Eigen::MatrixXcd::Random(rows, columns);
      Eigen::Map<Eigen::VectorXcd> x(reinterpret_cast<std::complex<double>*>(end) - columns, columns);
      x.setRandom();
      const Eigen::VectorXcd expected = a.lazyProduct(x);
      EXPECT_LT((product(a, x) - expected).norm(), 1e-13 * (1 + expected.norm())) << rows << " x " << columns;
    }
  munmap(pages, 2 * page);
}

// Products with few columns take another way than those with many.
TEST(DenseProduct, OfFewColumnsIsThatOfMany) {
  for (const Eigen::Index rows : {1, 63, 64, 65, 200})
    for (const Eigen::Index inner : {1, 7, 130})
      for (const Eigen::Index columns : {1, 2, 7, 16, 17, 40}) {
        const Eigen::MatrixXd stored = Eigen::MatrixXd::Random(inner + 3, rows + 2);
        const Eigen::MatrixXd b = Eigen::MatrixXd::Random(inner, columns);
        const auto a = stored.block(1, 2, inner, rows);
        const Eigen::MatrixXd expected = a.transpose().lazyProduct(b);
        EXPECT_LT((transposed_product(a, b) - expected).norm(), 1e-13 * (1 + expected.norm()))
            << rows << " x " << inner << " x " << columns;
      }
}

}  // namespace
}  // namespace dovetail::numerics
