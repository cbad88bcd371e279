/** Why files of these schemes are not checked: what they include is found beside them on the disk. */
export const whyUnserved: Readonly<Record<string, string>> = {
  untitled: "The file is not on the disk yet. Save it to have it checked.",
  git: "This is the file of a commit. The file of the workspace is checked.",
  gitfs: "This is the file of a commit. The file of the workspace is checked.",
  "vscode-vfs": "The folder is not on a disk. Clone the repository to have its launch files checked.",
  "vscode-remote": "The folder is on another machine. Install the extension there to have its launch files checked.",
};
