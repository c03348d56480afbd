//! CPM.
