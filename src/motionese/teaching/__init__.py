"""Teaching by a person: drawing, recognition, performing, learning, a session that is kept."""
