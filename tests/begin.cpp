// SPDX-License-Identifier: Apache-2.0
// Exists so that its precompiled headers are built once for all tests (tests/CMakeLists.txt).
