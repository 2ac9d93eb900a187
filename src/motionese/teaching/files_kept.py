"""Names of what a session's folder holds; without imports, for the server that has no robot."""

SESSION = "session.json"
DEMONSTRATIONS = "demonstrations.npz"
LOCK = ".lock"
