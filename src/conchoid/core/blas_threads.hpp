#pragma once

namespace conchoid {

/// OpenBLAS works on one thread while an object of this class exists: on more it would round differently for
/// different thread counts. The setting is one of the whole process, so objects are counted: the first one
/// remembers what the program had set, the last one restores it. Other BLAS libraries are left alone; one
/// that splits its sums over threads must be told by the program not to.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

}  // namespace conchoid
