// The words of the lessons. Their mazes and checks are in the module: crates/playground/src/lessons.
"use strict";

// What a task asks for: `rule` (lines), `walls` (clicks on edges), `cells` ("all", "one" or "path") and `moves` ("robot"
// or "compass"). `most` is the greatest number of moves.
const LESSONS = [
  {
    title: "Follow a wall",
    why: "A robot on the blue disc wants to go to G. It has no map and no memory. All it sees is which sides next to it are open.",
    tasks: [{
      text: "Write its rule. Wherever there is a choice, the robot goes to the first side on your list that is open.",
      rule: true,
      check: "Send the robot",
      hint: "Walk through a dark room with your right hand on the wall. An opening comes on your right: where do you go? There is none: what do you try next, and what last?",
      more: "You wrote a wall follower. There are two of them, one for each hand. Try the other hand: is its way as long?",
    }],
  },
  {
    title: "Why a wall follower fails",
    why: "This robot keeps its right hand on the wall: it tries right, ahead, left, back. In the last lesson this always worked.",
    tasks: [{
      text: "Remove one wall so that the robot never arrives. Click a wall to remove it. Click again to put it back.",
      walls: true,
      check: "Send the robot",
      hint: "Put a finger on the outer wall and follow all walls that are joined to it. The hand of the robot touches no others. Which single wall joins those around G to the rest?",
      more: "A loop alone does no harm. The goal has to lie at walls that are an island.",
    }, {
      text: "Here it goes round and round. Build one wall so that it arrives. A way has to stay open.",
      walls: true,
      check: "Send the robot",
      hint: "The walls around G are an island. A new wall can be a bridge from the island to walls that the robot's hand touches.",
      more: "A wall follower is right in mazes without islands. To be right in all mazes, a robot has to remember where it was: it needs a map.",
    }],
  },
  {
    title: "What a map needs",
    why: "This robot has a compass. At each place it sees which of the four ways are open: north (up), east, south, west. Without a memory, two places that look the same are one place on its map.",
    tasks: [{
      text: "Which places would it take for A? Click all of them.",
      cells: "all",
      check: "Check the places",
      hint: "Write down what the robot sees at A: north open or wall, east, south, west. Then go through the maze row by row and compare all four.",
      more: "Such a map says that you can be in several places at once. A robot that follows it is lost.",
    }, {
      text: "A and B look the same. Find the shortest walk after which they do not. The moves are the same from both. A move against a wall leaves the robot where it is.",
      moves: "compass",
      most: 6,
      check: "Walk from A and B",
      hint: "Put one finger on A and one on B, and move both in the same direction. After each move compare what the robot would see. A walk that stays in look-alike places tells nothing.",
      more: "With a compass and a memory of its moves, a robot can tell all places of a maze apart. Can you say why? Think of the cell farthest to the north.",
    }],
  },
  {
    title: "Where am I?",
    why: "This robot has the right map. It was lifted and put down, and knows neither its place nor which way it looks. It has no compass. It sees whether left, ahead and right are open.",
    tasks: [{
      text: "Drive it until only one cell fits everything that it saw. Then click the cell where it is now.",
      moves: "robot",
      drives: true,
      cells: "one",
      check: "It is here",
      hint: "List all cells, and ways to look, that fit the first view. After each move strike out those that do not fit. Drive to where few places look alike, such as a crossing.",
      more: "Each move rules out places. Moves that look the same everywhere rule out none.",
    }, {
      text: "Now it was put down in a dead end, looking at the wall: A, B, C or D. Write one plan that tells which it was, without seeing the robot. A move against a wall does nothing, but the robot notices.",
      moves: "robot",
      most: 6,
      check: "Try the plan",
      hint: "In a dead end only one move is possible at first. Then follow four fingers. Choose moves that are open for some of the robots and closed for others.",
      more: "A plan that works from everywhere exists in every maze in which the places can be told apart at all.",
    }],
  },
  {
    title: "Explore, prove, run",
    why: "A micromouse looks for the shortest run from the blue disc to G. It sees the walls of each cell that it enters. Dotted edges are unknown: a wall or a way.",
    tasks: [{
      text: "Click a cell next to the mouse to drive there. Press the button as soon as it is proven that no shorter run exists: not before, and not after.",
      cells: "path",
      check: "It is proven",
      hint: "Take every dotted edge for open. Is there now a shorter run than the shortest that you found? If so, drive to its first dotted edge. If not, it is proven.",
      more: "You never saw the rest of the maze, and yet you know that it holds no shorter run.",
    }, {
      text: "Here you see the whole maze. Click the cells that have to be seen to prove that the shortest run is the shortest. None may be needless.",
      cells: "all",
      check: "Check the proof",
      hint: "Begin with cells on the shortest run. The dashed line shows a shorter run that may still exist: see a cell where a wall stops it. When it is proven, take cells away again.",
      more: "A mouse that proves its run in this way saves the time for all other cells.",
    }],
  },
];
