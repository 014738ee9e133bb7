#pragma once
/// \file
/// The document room: what a user said about one plant, as one value, and everything that follows from it.
///
/// A Project is the value, read from and written to NAME.axil. The chain derives skeleton, numbers and grammars from it, and a
/// build writes all of them into a folder. For a window there are commands, each a line of text, a history of states, a journal
/// that survives the program, and a session that ties them to a file and keeps what is derived while its inputs stay.

#include "document/project.hpp"        // the value and its file
#include "document/chain.hpp"          // photos and clicks to skeleton, numbers, grammars
#include "document/build.hpp"          // all of it into a folder
#include "document/skeleton_file.hpp"  // skeleton.json
#include "document/command.hpp"        // what a user does
#include "document/command_text.hpp"   // a command as a line, and back
#include "document/history.hpp"        // undo and redo over states
#include "document/replay.hpp"         // many lines at once
#include "document/journal.hpp"        // nothing is lost
#include "document/derived.hpp"        // what follows, and the last good one while something is wrong
#include "document/session.hpp"        // a project being edited
