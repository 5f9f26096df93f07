#!/bin/sh
# The objects of the kernels define nothing that another file could define too: else the linker might keep the one that
# is compiled for a processor that is not there.  kernels.sh OBJECT...   (objects of others are passed over)
#
# Every symbol must carry the width of the lanes among its template arguments: Li1E (scalar), Li4E (avx2) or Li8E (avx512).
set -u

status=0 seen=0
for object in "$@"; do
  case $object in
    *kernel/scalar.cpp.o) width=1 ;;
    *kernel/avx2.cpp.o) width=4 ;;
    *kernel/avx512.cpp.o) width=8 ;;
    *) continue ;;
  esac
  seen=$((seen + 1))
  strangers=$(nm --defined-only "$object" | awk '$2 ~ /^[TWVu]$/ { print $3 }' | grep -vE "Li${width}E|^DW\.ref|^_ZTS|^_ZTI|asan|odr" | head -n 5)
  if [ -n "$strangers" ]; then
    echo "$object defines what other files may define too:"
    echo "$strangers"
    status=1
  fi
done
[ "$seen" -gt 0 ] || { echo "there is no object of a kernel among: $*"; exit 1; }
exit $status
