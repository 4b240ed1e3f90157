//! Home of the tests beside this file.
